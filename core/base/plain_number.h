// Numbers as text for machines: exact, with a point, whatever the locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace marsview {

/// The shortest digits that read back as the same double, always with a point ("1500.0"); "nan"
/// where there is no number.
std::string asText(double value);

/// The number that a word is; a plus before it and "nan" and "inf" are understood. Nothing where
/// anything else is in it.
std::optional<double> parseNumber(std::string_view word);

} // namespace marsview
