// Orientation tests without rounding error.
//
// Computed in doubles where an error bound proves the sign, else in expansions of doubles
// (J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
// predicates", Discrete & Computational Geometry 18, 1997). Coordinates are finite and at most
// 1e12, and no product of three differences underflows. Any thread; allocates nothing.
#pragma once

#include "core/base/vec.h"

namespace marsview {

/// 1 if `p` is on the side of the plane through a, b and c from which these are seen
/// counter-clockwise, -1 on the other, 0 on the plane or if a, b and c are collinear.
int sideOfPlane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) noexcept;

/// The same for the point `p` + `rest`, whose sum need not be a double.
int sideOfPlane(
    const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p, const Vec3& rest) noexcept;

/// 1 if (px, py) is to the left of the line from a to b, -1 to the right, 0 on it.
int sideOfLine(double ax, double ay, double bx, double by, double px, double py) noexcept;

/// The sign of a·d - b·c.
int signOfDeterminant(double a, double b, double c, double d) noexcept;

/// Whether the three points are on one line, or equal.
bool areCollinear(const Vec3& a, const Vec3& b, const Vec3& c) noexcept;

} // namespace marsview
