// One segment cast over the heightfield of a contact surface.
//
// Notation. A position is (u, v) in its cell. The surface's height is affine over a triangle, and
// so is f(t) = z(t) - surface(t) along a segment: one sign change decides hit and release together.
// Exact values stay exact: a position on an edge has the edge's coordinate as 0 or 1, one on a
// diagonal has u = v, and crossings of grid lines are snapped to them, where only the two samples
// of the line count, so that neighboring cells see the same f.
#pragma once

#include "core/contact/heightfield_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace marsview {

// One segment over the grid, cell by cell from its start. It skips blocks and larger nodes of the
// hierarchy that lie entirely below it in one step.
template <typename Heights>
class HeightfieldCast {
public:
    using Surface = BasicHeightfieldSurface<Heights>;
    using InCell = typename Surface::InCell;
    using Goal = typename Surface::Goal;
    using Cast = typename Surface::Cast;

    // `over` is the half of the start's cell over which the segment leaves the surface; empty if
    // the start is above the surface.
    HeightfieldCast(const Surface& surface,
                    const InCell& start,
                    double start_z,
                    std::optional<bool> over,
                    const Goal& goal) noexcept
        : surface_(surface)
        , terrain_(*surface.terrain_)
        , goal_(goal)
        , column_(start.column)
        , row_(start.row)
        , origin_column_(start.column)
        , origin_row_(start.row)
        , u_(start.u)
        , v_(start.v)
        , columns_((goal.grid.column - static_cast<double>(start.column)) - start.u)
        , rows_((goal.grid.row - static_cast<double>(start.row)) - start.v)
        , z_(start_z)
        , up_(goal.scene.z - start_z)
        , over_(over)
    {
        // Smaller values count as 0; their inverse would not be finite.
        constexpr double kLeast = 1e-300;
        columns_ = std::abs(columns_) < kLeast ? 0.0 : columns_;
        rows_ = std::abs(rows_) < kLeast ? 0.0 : rows_;
        per_column_ = columns_ == 0.0 ? 0.0 : 1.0 / columns_;
        per_row_ = rows_ == 0.0 ? 0.0 : 1.0 / rows_;
        // On a grid line, heading to smaller coordinates: the cell before it.
        if (u_ == 0.0 && columns_ < 0.0 && column_ > 0 && !over_) {
            --column_;
        }
        if (v_ == 0.0 && rows_ < 0.0 && row_ > 0 && !over_) {
            --row_;
        }
    }

    Cast cast() noexcept
    {
        if (over_ && stepInCell()) {
            return result_;
        }
        std::size_t level = 0;
        // Every iteration passes a cell, or a node that no later iteration returns to.
        while (true) {
            while (level > 0 && !isClear(level)) {
                --level;
            }
            if (level == 0 && !isClear(0)) {
                if (walkBlock()) {
                    return result_;
                }
                continue;
            }
            while (level + 1 < terrain_.levelCount() && exitOf(level) < 1.0 && isClear(level + 1)) {
                ++level;
            }
            if (passNode(level)) {
                return result_;
            }
        }
    }

private:
    static constexpr std::size_t kBlock = MinMaxPyramid::kBlock;

    // Where the segment crosses the grid line between two columns or rows.
    double timeOfColumn(std::int32_t line) const noexcept
    {
        return (static_cast<double>(line - origin_column_) - u_) * per_column_;
    }
    double timeOfRow(std::int32_t line) const noexcept
    {
        return (static_cast<double>(line - origin_row_) - v_) * per_row_;
    }
    double columnAt(double t) const noexcept
    {
        return static_cast<double>(origin_column_) + (u_ + t * columns_);
    }
    double rowAt(double t) const noexcept
    {
        return static_cast<double>(origin_row_) + (v_ + t * rows_);
    }
    double heightAt(double t) const noexcept { return t == 1.0 ? goal_.scene.z : z_ + t * up_; }

    struct Node {
        std::int32_t left;
        std::int32_t right; // the last grid line
        std::int32_t upper;
        std::int32_t lower;
    };
    Node nodeAt(std::size_t level) const noexcept
    {
        const auto shift = static_cast<int>(level) + 5;
        static_assert(kBlock == 1U << 5U);
        const std::int32_t left = (column_ >> shift) << shift;
        const std::int32_t upper = (row_ >> shift) << shift;
        const std::int64_t side = std::int64_t{1} << shift;
        return {
            left,
            static_cast<std::int32_t>(std::min<std::int64_t>(left + side, surface_.last_column_)),
            upper,
            static_cast<std::int32_t>(std::min<std::int64_t>(upper + side, surface_.last_row_))};
    }
    struct Exit {
        double t;
        bool by_column;
        bool by_row;
    };
    Exit exitFrom(const Node& node) const noexcept
    {
        // The border of the map is never crossed: goals lie on it at most.
        constexpr double kNever = std::numeric_limits<double>::infinity();
        double column = kNever;
        if (columns_ > 0.0 && node.right < surface_.last_column_) {
            column = timeOfColumn(node.right);
        } else if (columns_ < 0.0 && node.left > 0) {
            column = timeOfColumn(node.left);
        }
        double row = kNever;
        if (rows_ > 0.0 && node.lower < surface_.last_row_) {
            row = timeOfRow(node.lower);
        } else if (rows_ < 0.0 && node.upper > 0) {
            row = timeOfRow(node.upper);
        }
        const double t = std::max(std::min({column, row, 1.0}), t_);
        return {t, column <= t && column < 1.0, row <= t && row < 1.0};
    }
    double exitOf(std::size_t level) const noexcept { return exitFrom(nodeAt(level)).t; }

    bool isClear(std::size_t level) const noexcept
    {
        const double t = exitOf(level);
        const double lowest = std::min(heightAt(t_), heightAt(t));
        const auto shift = static_cast<int>(level) + 5;
        const double highest = surface_.exaggeration_ *
                               terrain_.maximum(level, static_cast<std::size_t>(column_ >> shift),
                                                static_cast<std::size_t>(row_ >> shift));
        return lowest > highest;
    }

    // Moves to the cell behind an exit. True if the segment ends before it.
    bool advance(const Node& node, const Exit& exit) noexcept
    {
        t_ = exit.t;
        entered_by_column_ = exit.by_column;
        entered_by_row_ = exit.by_row;
        if (!exit.by_column && !exit.by_row) {
            return true;
        }
        if (exit.by_column) {
            column_ = columns_ > 0.0 ? node.right : node.left - 1;
        } else {
            column_ = std::clamp(cellAt(columnAt(t_)), node.left, node.right - 1);
        }
        if (exit.by_row) {
            row_ = rows_ > 0.0 ? node.lower : node.upper - 1;
        } else {
            row_ = std::clamp(cellAt(rowAt(t_)), node.upper, node.lower - 1);
        }
        return false;
    }
    static std::int32_t cellAt(double position) noexcept
    {
        return static_cast<std::int32_t>(std::floor(position));
    }

    bool passNode(std::size_t level) noexcept
    {
        const Node node = nodeAt(level);
        return advance(node, exitFrom(node)); // above the maximum: the end is in free space
    }

    bool walkBlock() noexcept
    {
        const Node block = nodeAt(0);
        do {
            if (stepInCell()) {
                return true;
            }
        } while (column_ >= block.left && column_ < block.right && row_ >= block.upper &&
                 row_ < block.lower);
        return false;
    }

    // Processes one cell and moves to the next. True when the cast is complete.
    bool stepInCell() noexcept
    {
        ++result_.cells;
        const Node cell{column_, column_ + 1, row_, row_ + 1};
        const Exit exit = exitFrom(cell);
        const bool is_end = !exit.by_column && !exit.by_row;
        const CellHeights z = surface_.cellHeights(column_, row_);
        const auto leaving = std::exchange(over_, std::nullopt);
        const double highest =
            std::max(std::max(z.upper_left, z.upper_right), std::max(z.lower_left, z.lower_right));
        if (std::min(heightAt(t_), heightAt(exit.t)) <= highest) {
            InCell begin = inCell(t_);
            if (t_ == 0.0) {
                begin.u = static_cast<double>(origin_column_ - column_) + u_;
                begin.v = static_cast<double>(origin_row_ - row_) + v_;
            }
            if (entered_by_column_) {
                begin.u = columns_ > 0.0 ? 0.0 : 1.0;
            }
            if (entered_by_row_) {
                begin.v = rows_ > 0.0 ? 0.0 : 1.0;
            }
            InCell end = inCell(exit.t);
            if (exit.by_column) {
                end.u = columns_ > 0.0 ? 1.0 : 0.0;
            }
            if (exit.by_row) {
                end.v = rows_ > 0.0 ? 1.0 : 0.0;
            }
            if (is_end) {
                end.u = std::clamp(goal_.grid.column - static_cast<double>(column_), 0.0, 1.0);
                end.v = std::clamp(goal_.grid.row - static_cast<double>(row_), 0.0, 1.0);
            }
            if (castInCell(z, begin, end, exit.t, is_end, leaving)) {
                return true;
            }
        }
        return advance(cell, exit);
    }

    InCell inCell(double t) const noexcept
    {
        return {column_, row_, std::clamp(columnAt(t) - static_cast<double>(column_), 0.0, 1.0),
                std::clamp(rowAt(t) - static_cast<double>(row_), 0.0, 1.0)};
    }

    // True with the contact in result_ if the segment enters the surface in this cell, or ends on
    // it.
    bool castInCell(const CellHeights& z,
                    const InCell& begin,
                    const InCell& end,
                    double t_end,
                    bool is_end,
                    std::optional<bool> leaving) noexcept
    {
        const double f_begin =
            leaving ? 0.0 : std::max(heightAt(t_) - heightInCell(z, begin.u, begin.v), 0.0);
        // At the goal, computed as in isAbove().
        const double f_end = is_end ? goal_.scene.z - surface_.height(goal_.grid)
                                    : heightAt(t_end) - heightInCell(z, end.u, end.v);
        const double w_begin = begin.u - begin.v;
        const double w_end = end.u - end.v;
        if ((w_begin > 0.0 && w_end < 0.0) || (w_begin < 0.0 && w_end > 0.0)) {
            const double share = w_begin / (w_begin - w_end);
            const double t = t_ + (t_end - t_) * share;
            InCell middle = begin;
            middle.u = std::clamp(begin.u + (end.u - begin.u) * share, 0.0, 1.0);
            middle.v = middle.u; // on the diagonal, exactly
            const double f_middle = heightAt(t) - heightInCell(z, middle.u, middle.v);
            return (!leaving && f_middle < 0.0 &&
                    hit(begin, middle, f_begin, f_middle, w_begin > 0.0)) ||
                   isHit(middle, end, std::max(f_middle, 0.0), f_end, w_end > 0.0, is_end);
        }
        if (leaving && !is_end) {
            return false; // the only piece, over the face over which it leaves
        }
        // On the diagonal, the origin or direction of the segment determines the half.
        const bool is_upper = leaving          ? *leaving
                              : w_begin == 0.0 ? (w_end != 0.0 ? w_end > 0.0 : columns_ >= rows_)
                                               : w_begin > 0.0;
        if (leaving) {
            return f_end <= 0.0 && hit(end, end, 0.0, 0.0, is_upper);
        }
        return isHit(begin, end, f_begin, f_end, is_upper, is_end);
    }

    bool isHit(const InCell& begin,
               const InCell& end,
               double f_begin,
               double f_end,
               bool is_upper,
               bool is_end) noexcept
    {
        return (f_end < 0.0 || (is_end && f_end == 0.0)) &&
               hit(begin, end, f_begin, f_end, is_upper);
    }

    bool hit(const InCell& begin,
             const InCell& end,
             double f_begin,
             double f_end,
             bool is_upper) noexcept
    {
        const double share = f_end == 0.0 ? 1.0 : f_begin / (f_begin - f_end);
        InCell at = begin;
        at.u = std::clamp(begin.u + (end.u - begin.u) * share, 0.0, 1.0);
        at.v = std::clamp(begin.v + (end.v - begin.v) * share, 0.0, 1.0);
        if (share == 1.0) {
            at = end;
        }
        result_.contact = surface_.contactIn(at, is_upper);
        return true;
    }

    const Surface& surface_;
    const typename Heights::Terrain& terrain_;
    const Goal& goal_;
    std::int32_t column_; // of the cell where the segment is at t_
    std::int32_t row_;
    std::int32_t origin_column_;
    std::int32_t origin_row_;
    double u_; // of the start, in the cell of the origin
    double v_;
    double columns_; // from start to goal
    double rows_;
    double z_;
    double up_;
    double per_column_ = 0.0;
    double per_row_ = 0.0;
    double t_ = 0.0;
    bool entered_by_column_ = false;
    bool entered_by_row_ = false;
    std::optional<bool> over_;
    Cast result_;
};

} // namespace marsview
