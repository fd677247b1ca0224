// NaN, the value of voids and failures.
#pragma once

#include <limits>

namespace marsview {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr float kNanFloat = std::numeric_limits<float>::quiet_NaN();

} // namespace marsview
