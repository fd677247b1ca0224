// Writes results: independent of the locale, and exact.
#pragma once

#include "core/base/plain_number.h" // IWYU pragma: export

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace marsview {

/// The value of "schema" in all --json output. It changes when a field is removed or changes its
/// meaning; resources/guide/json.md lists the fields.
constexpr int kJsonSchema = 1;

/// A number for JSON, which has no NaN: null instead.
nlohmann::ordered_json asJson(double value);

/// `fields` with "schema" before them.
nlohmann::ordered_json withSchema(const nlohmann::ordered_json& fields);

enum class JsonLayout { Indented, OneLine };

/// Writes JSON to stdout; bytes that are not UTF-8 are replaced.
void printJson(const nlohmann::ordered_json& json, JsonLayout layout = JsonLayout::Indented);

/// The text with spaces in place of line breaks and other control characters, which file names may
/// contain.
std::string asOneLine(std::string text);

/// Writes the text and a newline to stdout.
void printLine(const std::string& text);

enum class ErrorForm { Line, Json };

/// Writes an error to stderr: as "marsview-cli: <message>", or as a one-line JSON object with what
/// failed, why, and the exit status. `message` has the form "<file or option>: <why>".
void printError(const std::string& message, int exit_status, ErrorForm form);

} // namespace marsview
