// Doubles as floats that bound them.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
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

/// How much larger roundedUpShort() may be than its argument, as a share of it.
inline constexpr float kShortRounding = 1.0F / 128.0F;

/// The smallest float of 8 significant bits that is not below `value` >= 0. The other bits are 0,
/// so that an array of them compresses to half the size.
inline float roundedUpShort(float value) noexcept
{
    constexpr std::uint32_t kCutOff = 0xFFFF;
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return std::bit_cast<float>((bits + kCutOff) & ~kCutOff);
}

} // namespace marsview
