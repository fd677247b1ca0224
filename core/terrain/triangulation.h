// The surface between samples.
//
// Each cell is divided by the diagonal from sample (c, r) to (c+1, r+1):
//
//   (c, r) ────── (c+1, r)
//     │  ╲  upper    │         u: fraction of a column, to the right
//     │    ╲         │         v: fraction of a row, downward
//     │ lower ╲      │
//   (c, r+1) ──── (c+1, r+1)
#pragma once

#include <limits>

namespace marsview {

/// Heights of a cell's corners in meters; NaN if void.
struct CellHeights {
    double upper_left;
    double upper_right;
    double lower_left;
    double lower_right;
};

/// Height at (u, v) in [0, 1]². Error against exact arithmetic: at most 4 ulp of the largest
/// corner. A corner without influence may be void: at a corner the result is that sample itself, on
/// an edge only its two ends count, so neighboring cells agree bit for bit. Otherwise NaN if one of
/// the triangle's corners is void.
inline double heightInCell(const CellHeights& z, double u, double v) noexcept
{
    // Weights of the three corners. Differences of corners are avoided: they would make the result
    // at u = 1 differ from the corner by rounding.
    const auto blend = [](double w, double z_w) { return w == 0.0 ? 0.0 : w * z_w; };
    if (u >= v) {
        return blend(1.0 - u, z.upper_left) + blend(u - v, z.upper_right) + blend(v, z.lower_right);
    }
    return blend(1.0 - v, z.upper_left) + blend(v - u, z.lower_left) + blend(u, z.lower_right);
}

} // namespace marsview
