// Angles as a type, so that degrees and radians never mix.
#pragma once

#include <cmath>
#include <compare>
#include <numbers>

namespace marsview {

/// An angle of any size; never wrapped unless a function says so.
class Angle {
public:
    constexpr Angle() = default;

    static constexpr Angle radians(double value) { return Angle(value); }
    static constexpr Angle degrees(double value)
    {
        return Angle(value * (std::numbers::pi / 180.0));
    }

    constexpr double radians() const { return radians_; }
    /// Within 1 ulp of the degrees it was made from.
    constexpr double degrees() const { return radians_ * (180.0 / std::numbers::pi); }

    constexpr Angle operator-() const { return Angle(-radians_); }
    constexpr Angle operator+(Angle other) const { return Angle(radians_ + other.radians_); }
    constexpr Angle operator-(Angle other) const { return Angle(radians_ - other.radians_); }
    constexpr Angle operator*(double factor) const { return Angle(radians_ * factor); }
    constexpr auto operator<=>(const Angle&) const = default; // NOLINT(modernize-use-nullptr)

private:
    constexpr explicit Angle(double radians)
        : radians_(radians)
    {}

    double radians_ = 0.0;
};

} // namespace marsview
