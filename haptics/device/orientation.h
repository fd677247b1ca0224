// How a stylus is held.
#pragma once

#include <array>

namespace marsview {

/// A unit quaternion: the rotation that takes the stylus from its reference orientation, level with
/// the tip away from the user, to its present one, in the workspace frame (right-handed; x right, y
/// away from the user, z up).
struct Orientation {
    double w = 1.0;
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;

    constexpr bool operator==(const Orientation&) const = default;
};

/// The quaternion of a rotation matrix given by rows, with w >= 0. Elements may be off by 1e-6; the
/// result has unit length. The identity if the matrix is not a rotation. Real-time safe.
Orientation orientationOf(const std::array<std::array<double, 3>, 3>& rotation) noexcept;

bool isFinite(const Orientation& orientation) noexcept;

/// Whether the length differs from 1 by at most a percent.
bool isUnit(const Orientation& orientation) noexcept;

/// The angle of the part of the rotation that turns about the stylus's own axis, -pi to pi:
/// positive counter-clockwise seen from the back end of the stylus, which is from above if the tip
/// points down. 0 if the stylus points exactly backward, where it is undefined.
double twistOf(const Orientation& orientation) noexcept;

} // namespace marsview
