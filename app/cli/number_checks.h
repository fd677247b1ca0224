// Numbers among the options of every command.
#pragma once

namespace CLI {
class Validator;
}

namespace marsview {

// CLI11 reads "nan" and "inf" as numbers, lets NaN through its ranges, and writes the bounds of
// CLI::PositiveNumber with 300 digits.
CLI::Validator finiteNumber();
/// Finite and more than 0.
CLI::Validator positiveNumber();

} // namespace marsview
