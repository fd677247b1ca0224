// Checks of option values. Each error message is phrased to follow the option's name.
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

/// Including NaN and infinities.
CLI::Validator anyNumber();
CLI::Validator finiteNumber();
/// Finite and greater than 0.
CLI::Validator positiveNumber();
/// Finite and not 0.
CLI::Validator nonZeroNumber();
/// Both ends included.
CLI::Validator numberFrom(double low, double high);
/// A vertical exaggeration.
CLI::Validator exaggerationFactor();
CLI::Validator wholeNumberFrom(std::uint64_t low, std::uint64_t high);
/// One of these words, case-sensitive; the error suggests the nearest one.
CLI::Validator oneOf(std::vector<std::string> words);
/// Anything but white space.
CLI::Validator someText();
/// For every option that names a file or folder: converts "file://" addresses to paths, for
/// CLI::Option::transform. Call it before fileNameEndingIn().
CLI::Validator fileName();
/// A name with one of these extensions (".png"), case-insensitive.
CLI::Validator fileNameEndingIn(std::vector<std::string> endings);

} // namespace marsview
