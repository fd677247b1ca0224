// Numbers as text for machines: exact and with a decimal point in every locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace marsview {

/// The shortest digits that read back as the same double, always with a point ("1500.0"); "nan" for
/// NaN.
std::string asText(double value);

/// Parses a whole word as a number; a leading plus, "nan" and "inf" are accepted. Empty if the word
/// contains anything else.
std::optional<double> parseNumber(std::string_view word);

} // namespace marsview
