// Usage errors: checks before any file is opened.
#pragma once

#include "core/base/result.h"

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace marsview {

/// Converts the arguments, without the program's name, to the form that the parser of `app` reads:
/// numbers that belong together are separated, whether they were written with commas, blanks or
/// both, and negative ones stay with their option; `--help` and `--version` are recognized at any
/// position. Unknown commands and options, missing and superfluous values are errors that suggest
/// the nearest name. The message has the form "<option>: <what and why>".
Result<std::vector<std::string>> normalizedArguments(const CLI::App& app,
                                                     const std::vector<std::string>& arguments);

/// The parser's error as "<option>: <what and why>", with the name of the option that was typed.
std::string usageMessage(const CLI::App& app,
                         const std::vector<std::string>& arguments,
                         const CLI::ParseError& error);

/// "marsview-cli sample" for the arguments of that command, or the closest match.
std::string commandName(const CLI::App& app, const std::vector<std::string>& arguments);

} // namespace marsview
