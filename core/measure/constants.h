// Numbers that several measures need.
#pragma once

#include <limits>
#include <numbers>

namespace marsview {

inline constexpr double kNoMeasure = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

} // namespace marsview
