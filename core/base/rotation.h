// Rotations in space.
#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace marsview {

/// The unit vectors that x, y and z become. A small value; any thread.
struct Rotation {
    Vec3 x{1.0, 0.0, 0.0};
    Vec3 y{0.0, 1.0, 0.0};
    Vec3 z{0.0, 0.0, 1.0};

    constexpr bool operator==(const Rotation&) const = default;

    constexpr Vec3 operator*(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
    constexpr Rotation operator*(const Rotation& first) const
    {
        return {*this * first.x, *this * first.y, *this * first.z};
    }
    constexpr Rotation inverse() const
    {
        return {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}};
    }

    /// By the length of `turn`, in radians, counterclockwise seen from its tip.
    static Rotation by(const Vec3& turn) noexcept
    {
        const double angle = length(turn);
        if (!(angle > 0.0)) {
            return {};
        }
        const Vec3 axis = turn * (1.0 / angle);
        const double sine = std::sin(angle);
        const double half_sine = std::sin(0.5 * angle);
        const double rest = 2.0 * half_sine * half_sine; // 1 - cosine, without cancellation
        const auto turned = [&](const Vec3& v) {
            return v + cross(axis, v) * sine + cross(axis, cross(axis, v)) * rest;
        };
        return {turned({1.0, 0.0, 0.0}), turned({0.0, 1.0, 0.0}), turned({0.0, 0.0, 1.0})};
    }
    /// The shortest one from one unit vector to another; one of them, if these are opposite.
    static Rotation carrying(const Vec3& from, const Vec3& to) noexcept
    {
        const Vec3 normal = cross(from, to);
        const double sine = length(normal);
        const double cosine = dot(from, to);
        constexpr double kStraight = 1e-300;
        if (sine > kStraight) {
            return by(normal * (std::atan2(sine, cosine) / sine));
        }
        if (cosine > 0.0) {
            return {};
        }
        const Vec3 across = std::abs(from.x) < 0.5 ? cross(from, Vec3{1.0, 0.0, 0.0})
                                                   : cross(from, Vec3{0.0, 1.0, 0.0});
        return by(normalized(across) * std::numbers::pi);
    }
    /// The axis, as long as the angle in radians: by() gives this rotation again. Half a turn at
    /// most, whose axis is one of two.
    Vec3 turn() const noexcept
    {
        const Vec3 twice_sine{y.z - z.y, z.x - x.z, x.y - y.x};
        const double sine = 0.5 * length(twice_sine);
        const double cosine = 0.5 * (x.x + y.y + z.z - 1.0);
        const double angle = std::atan2(sine, cosine);
        constexpr double kSmall = 1e-8;
        if (sine > kSmall) {
            return twice_sine * (0.5 * angle / sine);
        }
        if (cosine > 0.0) {
            return twice_sine * 0.5;
        }
        // Half a turn: its axis is halfway between a vector and what that becomes.
        const Vec3 a = x + Vec3{1.0, 0.0, 0.0};
        const Vec3 b = y + Vec3{0.0, 1.0, 0.0};
        const Vec3 c = z + Vec3{0.0, 0.0, 1.0};
        const Vec3 axis = dot(a, a) >= std::max(dot(b, b), dot(c, c)) ? a
                          : dot(b, b) >= dot(c, c)                    ? b
                                                                      : c;
        return normalized(axis) * angle;
    }
    /// Without the rounding errors that products collect.
    Rotation orthonormal() const noexcept
    {
        const Vec3 up = normalized(z);
        const Vec3 first = normalized(x - up * dot(x, up));
        return {first, cross(up, first), up};
    }
};

} // namespace marsview
