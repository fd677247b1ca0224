// Numbers among the options and in files of numbers, for every command.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string_view>

namespace marsview {

// CLI11 reads "nan" and "inf" as numbers, lets NaN through its ranges, and writes the bounds of
// CLI::PositiveNumber with 300 digits.
CLI::Validator finiteNumber();
/// Finite and more than 0.
CLI::Validator positiveNumber();

/// The number that a word is, whatever the locale; a plus before it and "nan" and "inf" are
/// understood. Nothing where anything else is in it.
std::optional<double> parseNumber(std::string_view word);

} // namespace marsview
