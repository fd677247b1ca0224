// Doubles as floats that bound them.
#pragma once

#include <cmath>
#include <limits>

namespace marsview {

/// The largest float that is not above `value`. NaN stays NaN.
inline float roundedDown(double value) noexcept
{
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) > value
               ? std::nextafterf(nearest, -std::numeric_limits<float>::infinity())
               : nearest;
}

/// The smallest float that is not below `value`. NaN stays NaN.
inline float roundedUp(double value) noexcept
{
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) < value
               ? std::nextafterf(nearest, std::numeric_limits<float>::infinity())
               : nearest;
}

} // namespace marsview
