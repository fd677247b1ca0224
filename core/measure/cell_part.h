// Convex parts of a grid cell: clipping and integrals.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace marsview {

/// u and v are shares of the way across the cell, from its upper left corner.
struct UvPoint {
    double u = 0.0;
    double v = 0.0;
    double g = 0.0; // height above the base
};
/// Four corners clipped by two lines and the base have at most seven.
struct CellPart {
    std::array<UvPoint, 8> points;
    std::size_t count = 0;

    void add(const UvPoint& point)
    {
        if (count < points.size()) {
            points[count++] = point;
        }
    }
};

/// The part where `side` is not negative.
template <typename Side>
CellPart clipped(const CellPart& part, const Side& side)
{
    CellPart kept;
    for (std::size_t i = 0; i < part.count; ++i) {
        const UvPoint& a = part.points[i];
        const UvPoint& b = part.points[(i + 1) % part.count];
        const double sa = side(a);
        const double sb = side(b);
        if (sa >= 0.0) {
            kept.add(a);
        }
        if ((sa > 0.0 && sb < 0.0) || (sa < 0.0 && sb > 0.0)) {
            const double t = sa / (sa - sb);
            kept.add({a.u + t * (b.u - a.u), a.v + t * (b.v - a.v), a.g + t * (b.g - a.g)});
        }
    }
    return kept;
}

/// A linear function on a cell.
struct LinearOnCell {
    double at_corner = 0.0; // u = v = 0
    double per_u = 0.0;
    double per_v = 0.0;

    double operator()(const UvPoint& p) const { return at_corner + p.u * per_u + p.v * per_v; }
};

/// Calls `visit` with the triangles of a part, each with its share of the cell.
template <typename Visit>
void forEachTriangle(const CellPart& part, const Visit& visit)
{
    for (std::size_t i = 1; i + 1 < part.count; ++i) {
        const UvPoint& o = part.points[0];
        const UvPoint& a = part.points[i];
        const UvPoint& b = part.points[i + 1];
        visit(o, a, b, 0.5 * std::abs((a.u - o.u) * (b.v - o.v) - (b.u - o.u) * (a.v - o.v)));
    }
}

/// The mean of the product of two linear functions over a triangle, from their values at its
/// corners.
inline double meanProduct(const std::array<double, 3>& f, const std::array<double, 3>& g)
{
    return ((f[0] + f[1] + f[2]) * (g[0] + g[1] + g[2]) + f[0] * g[0] + f[1] * g[1] + f[2] * g[2]) /
           12.0;
}

struct PartSum {
    double area_m2 = 0.0;
    double first = 0.0; // integral of a linear function over that area
};

/// Over the part; exact for a linear `value`. `cell_m2` is the area of a cell as the ground around
/// a point has it: it changes across a cell, threefold next to a pole of a map in degrees.
template <typename Value>
PartSum sumOver(const CellPart& part, const LinearOnCell& cell_m2, const Value& value)
{
    PartSum sum;
    forEachTriangle(part, [&](const UvPoint& o, const UvPoint& a, const UvPoint& b, double cells) {
        const std::array m2{cell_m2(o), cell_m2(a), cell_m2(b)};
        sum.area_m2 += cells * (m2[0] + m2[1] + m2[2]) / 3.0;
        sum.first += cells * meanProduct(m2, {value(o), value(a), value(b)});
    });
    return sum;
}

} // namespace marsview
