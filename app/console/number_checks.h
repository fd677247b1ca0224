// Checks of option values. Each refusal is half a sentence that follows the option's name.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class Validator;
}

namespace marsview {

// CLI11 reads "nan" and "inf" as numbers, lets NaN through its ranges, and writes the bounds of
// CLI::PositiveNumber with 300 digits.

/// NaN and infinities included.
CLI::Validator anyNumber();
CLI::Validator finiteNumber();
/// Finite and more than 0.
CLI::Validator positiveNumber();
/// Finite and not 0.
CLI::Validator nonZeroNumber();
/// Both ends included.
CLI::Validator numberFrom(double low, double high);
CLI::Validator wholeNumberFrom(std::uint64_t low, std::uint64_t high);
/// One of these words, case-sensitive; the refusal suggests the nearest one.
CLI::Validator oneOf(std::vector<std::string> words);
/// A name that ends in one of these (".png"), whatever its case.
CLI::Validator fileNameEndingIn(std::vector<std::string> endings);

} // namespace marsview
