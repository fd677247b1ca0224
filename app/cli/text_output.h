// How results are written: independent of the locale, and exact.
#pragma once

#include "core/base/plain_number.h" // IWYU pragma: export

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace marsview {

/// A number for JSON, which knows no NaN: null instead.
nlohmann::ordered_json asJson(double value);

/// The text with spaces for line breaks and other control characters, which file names may hold.
std::string asOneLine(std::string text);

/// Writes the text and a newline to stdout.
void printLine(const std::string& text);

} // namespace marsview
