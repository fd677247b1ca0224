// Notation. The ray is (c, r, z)(t) = origin + t · direction in columns, rows and meters. Over one
// triangle the surface is affine in (c, r), hence g(t) = z(t) - surface(t) is affine in t and a
// sign change is the hit. Heights at the ends of a piece are evaluated at coordinates snapped to
// the line that is crossed; there only the two samples of that line count (triangulation.h), so
// neighboring pieces see the same g and no ray slips through between them.

#include "core/terrain/ray_cast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace marsview {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Interval {
    double begin = 0.0;
    double end = kInfinity;
    bool isEmpty() const noexcept { return !(begin <= end); }
};

// The part of `interval` in which origin + t · slope is within [low, high]. Widened by the rounding
// error, so that no contact is lost; the cells reject the excess.
Interval clipped(Interval interval, double origin, double slope, double low, double high)
{
    if (slope == 0.0) {
        return origin >= low && origin <= high ? interval : Interval{1.0, 0.0};
    }
    double t0 = (low - origin) / slope;
    double t1 = (high - origin) / slope;
    if (t0 > t1) {
        std::swap(t0, t1);
    }
    const double slack = 8.0 * std::numeric_limits<double>::epsilon();
    return {std::max(interval.begin, t0 - slack * std::abs(t0)),
            std::min(interval.end, t1 + slack * std::abs(t1))};
}

// A position inside one cell.
struct InCell {
    double t;
    double u;
    double v;
};

// Cells of samples in memory.
struct HeldCells {
    const Heightfield& heightfield;

    CellHeights cell(std::size_t column, std::size_t row) const
    {
        return heightfield.cell(column, row);
    }
};

// Cells of the resident tiles.
struct TiledCells {
    mutable TileCursor cursor;

    CellHeights cell(std::size_t column, std::size_t row) const
    {
        return {cursor.sample(column, row), cursor.sample(column + 1, row),
                cursor.sample(column, row + 1), cursor.sample(column + 1, row + 1)};
    }
};

template <typename Cells>
class Caster {
public:
    Caster(const Cells& cells,
           const Heightfield& heightfield,
           const MinMaxPyramid& pyramid,
           const GridRay& ray)
        : cells_(cells)
        , pyramid_(pyramid)
        , ray_(ray)
        , cell_columns_(heightfield.columns() - 1)
        , cell_rows_(heightfield.rows() - 1)
    {}

    std::optional<RayHit> cast() const
    {
        // Depth first, nearer children on top. Each level leaves at most three siblings behind.
        std::array<Node, 128> stack;
        std::size_t count = 0;
        const std::size_t top = pyramid_.levelCount() - 1;
        if (const auto root = enter(top, 0, 0)) {
            stack[count++] = *root;
        }
        while (count > 0) {
            const Node node = stack[--count];
            if (node.level == 0) {
                if (const auto hit = castInBlock(node)) {
                    return hit;
                }
                continue;
            }
            // Children are inserted above the nodes on the stack, the nearest on top.
            const std::size_t base = count;
            const std::size_t level = node.level - 1;
            for (std::size_t row = 2 * node.row;
                 row < std::min(2 * node.row + 2, pyramid_.rows(level)); ++row) {
                for (std::size_t column = 2 * node.column;
                     column < std::min(2 * node.column + 2, pyramid_.columns(level)); ++column) {
                    if (const auto child = enter(level, column, row)) {
                        std::size_t place = count++;
                        for (; place > base && stack[place - 1].order < child->order; --place) {
                            stack[place] = stack[place - 1];
                        }
                        stack[place] = *child;
                    }
                }
            }
        }
        return std::nullopt;
    }

private:
    struct Node {
        std::size_t level = 0;
        std::size_t column = 0;
        std::size_t row = 0;
        Interval interval; // within the node's rectangle
        double order = 0.0;
    };

    // The node if the ray passes through its box, otherwise empty.
    std::optional<Node> enter(std::size_t level, std::size_t column, std::size_t row) const
    {
        const MinMaxPyramid::Bounds bounds = pyramid_.bounds(level, column, row);
        if (bounds.isEmpty()) {
            return std::nullopt;
        }
        const std::size_t side = MinMaxPyramid::kBlock << level;
        const double left = static_cast<double>(column * side);
        const double right = static_cast<double>(std::min((column + 1) * side, cell_columns_));
        const double upper = static_cast<double>(row * side);
        const double lower = static_cast<double>(std::min((row + 1) * side, cell_rows_));
        Interval interval = clipped({}, ray_.origin.column, ray_.columns_per_t, left, right);
        interval = clipped(interval, ray_.origin.row, ray_.rows_per_t, upper, lower);
        if (interval.isEmpty()) {
            return std::nullopt;
        }
        const Interval in_height =
            clipped(interval, ray_.origin_height_m, ray_.height_per_t_m,
                    static_cast<double>(bounds.minimum_m), static_cast<double>(bounds.maximum_m));
        if (in_height.isEmpty()) {
            return std::nullopt;
        }
        // Rectangles of siblings only share borders, so their middles are in the ray's order.
        const double order = std::isfinite(interval.end)
                                 ? interval.begin + (interval.end - interval.begin) / 2.0
                                 : interval.begin;
        return Node{level, column, row, interval, order};
    }

    double columnAt(double t) const { return ray_.origin.column + t * ray_.columns_per_t; }
    double rowAt(double t) const { return ray_.origin.row + t * ray_.rows_per_t; }

    // The cell on the side of `position` where the ray continues.
    static std::size_t cellAt(double position, double slope, std::size_t low, std::size_t high)
    {
        const double floor = std::floor(position);
        const double cell = floor == position && slope < 0.0 ? floor - 1.0 : floor;
        return static_cast<std::size_t>(
            std::clamp(cell, static_cast<double>(low), static_cast<double>(high - 1)));
    }

    std::optional<RayHit> castInBlock(const Node& node) const
    {
        const std::size_t left = node.column * MinMaxPyramid::kBlock;
        const std::size_t right = std::min(left + MinMaxPyramid::kBlock, cell_columns_);
        const std::size_t upper = node.row * MinMaxPyramid::kBlock;
        const std::size_t lower = std::min(upper + MinMaxPyramid::kBlock, cell_rows_);
        double t = node.interval.begin;
        std::size_t column = cellAt(columnAt(t), ray_.columns_per_t, left, right);
        std::size_t row = cellAt(rowAt(t), ray_.rows_per_t, upper, lower);
        InCell begin = inCell(t, column, row);
        if (ray_.columns_per_t == 0.0 && ray_.rows_per_t == 0.0) {
            return castVertically(cells_.cell(column, row), column, row, begin);
        }
        while (true) {
            const double t_column = crossing(ray_.origin.column, ray_.columns_per_t, column);
            const double t_row = crossing(ray_.origin.row, ray_.rows_per_t, row);
            const double t_end = std::min({t_column, t_row, node.interval.end});
            InCell end = inCell(std::max(t_end, t), column, row);
            const bool crosses_column = t_column == t_end;
            const bool crosses_row = t_row == t_end;
            if (crosses_column) {
                end.u = ray_.columns_per_t > 0.0 ? 1.0 : 0.0;
            }
            if (crosses_row) {
                end.v = ray_.rows_per_t > 0.0 ? 1.0 : 0.0;
            }
            if (const auto hit = castInCell(column, row, begin, end)) {
                return hit;
            }
            if (!crosses_column && !crosses_row) {
                return std::nullopt; // the ray ends, or leaves the block, inside this cell
            }
            t = end.t;
            begin = end;
            if (crosses_column) {
                if (ray_.columns_per_t > 0.0 ? ++column == right : column-- == left) {
                    return std::nullopt;
                }
                begin.u = ray_.columns_per_t > 0.0 ? 0.0 : 1.0;
            }
            if (crosses_row) {
                if (ray_.rows_per_t > 0.0 ? ++row == lower : row-- == upper) {
                    return std::nullopt;
                }
                begin.v = ray_.rows_per_t > 0.0 ? 0.0 : 1.0;
            }
        }
    }

    // Where the ray leaves a cell in one axis.
    static double crossing(double origin, double slope, std::size_t cell)
    {
        if (slope == 0.0) {
            return kInfinity;
        }
        return (static_cast<double>(slope > 0.0 ? cell + 1 : cell) - origin) / slope;
    }

    InCell inCell(double t, std::size_t column, std::size_t row) const
    {
        return {t, std::clamp(columnAt(t) - static_cast<double>(column), 0.0, 1.0),
                std::clamp(rowAt(t) - static_cast<double>(row), 0.0, 1.0)};
    }

    double rayHeight(double t) const { return ray_.origin_height_m + t * ray_.height_per_t_m; }

    std::optional<RayHit>
    castInCell(std::size_t column, std::size_t row, const InCell& begin, const InCell& end) const
    {
        const CellHeights cell = cells_.cell(column, row);
        const double before = begin.u - begin.v;
        const double after = end.u - end.v;
        if ((before < 0.0 && after > 0.0) || (before > 0.0 && after < 0.0)) {
            const double share = before / (before - after);
            InCell middle{begin.t + (end.t - begin.t) * share, begin.u + (end.u - begin.u) * share,
                          0.0};
            middle.v = middle.u; // on the diagonal, exactly
            if (const auto hit = castInTriangle(cell, column, row, begin, middle)) {
                return hit;
            }
            return castInTriangle(cell, column, row, middle, end);
        }
        return castInTriangle(cell, column, row, begin, end);
    }

    // Between two points of one triangle's closed area.
    std::optional<RayHit> castInTriangle(const CellHeights& cell,
                                         std::size_t column,
                                         std::size_t row,
                                         const InCell& begin,
                                         const InCell& end) const
    {
        const double surface_begin = heightInCell(cell, begin.u, begin.v);
        const double surface_end = heightInCell(cell, end.u, end.v);
        const double g_begin = rayHeight(begin.t) - surface_begin;
        const double g_end = rayHeight(end.t) - surface_end;
        // An endpoint on the rim of a hole is solid although the piece is not.
        if (g_begin == 0.0) {
            return hitAt(column, row, begin, surface_begin);
        }
        const double middle = heightInCell(cell, (begin.u + end.u) / 2.0, (begin.v + end.v) / 2.0);
        if (!std::isnan(middle) && ((g_begin < 0.0) != (g_end < 0.0)) && !std::isnan(g_begin) &&
            !std::isnan(g_end)) {
            const double share = g_begin / (g_begin - g_end);
            const InCell at{begin.t + (end.t - begin.t) * share,
                            begin.u + (end.u - begin.u) * share,
                            begin.v + (end.v - begin.v) * share};
            return hitAt(column, row, at, surface_begin + (surface_end - surface_begin) * share);
        }
        if (g_end == 0.0) {
            return hitAt(column, row, end, surface_end);
        }
        return std::nullopt;
    }

    std::optional<RayHit> castVertically(const CellHeights& cell,
                                         std::size_t column,
                                         std::size_t row,
                                         const InCell& at) const
    {
        const double surface = heightInCell(cell, at.u, at.v);
        const double t = (surface - ray_.origin_height_m) / ray_.height_per_t_m;
        if (!(t >= 0.0) || !std::isfinite(t)) {
            return std::nullopt; // a hole, or behind the origin
        }
        return hitAt(column, row, {t, at.u, at.v}, surface);
    }

    static std::optional<RayHit>
    hitAt(std::size_t column, std::size_t row, const InCell& at, double height_m)
    {
        return RayHit{
            {static_cast<double>(column) + at.u, static_cast<double>(row) + at.v}, height_m, at.t};
    }

    const Cells& cells_;
    const MinMaxPyramid& pyramid_;
    const GridRay& ray_;
    std::size_t cell_columns_;
    std::size_t cell_rows_;
};

} // namespace

GridRay gridRay(const ScenePoint& origin,
                const Vec3& direction,
                const SceneFrame& frame,
                double exaggeration)
{
    const GridPoint start = frame.toGrid(origin);
    // Only the linear part, to avoid cancellation far from the origin.
    SceneFrame linear = frame;
    linear.origin = {};
    const GridPoint slope = linear.toGrid(direction);
    return {.origin = start,
            .origin_height_m = origin.z / exaggeration,
            .columns_per_t = slope.column,
            .rows_per_t = slope.row,
            .height_per_t_m = direction.z / exaggeration};
}

std::optional<RayHit>
castRay(const Heightfield& heightfield, const MinMaxPyramid& pyramid, const GridRay& ray)
{
    if (!heightfield.isTiled()) {
        const HeldCells cells{heightfield};
        return Caster(cells, heightfield, pyramid, ray).cast();
    }
    const TiledCells cells{
        TileCursor(*heightfield.tiles(), heightfield.scale(), TileAccess::Resident)};
    return Caster(cells, heightfield, pyramid, ray).cast();
}

} // namespace marsview
