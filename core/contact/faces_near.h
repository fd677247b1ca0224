// The faces of a surface near a box.
#pragma once

#include "core/contact/heightfield_surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace marsview {

/// A box along the axes of the scene.
struct SceneBounds {
    ScenePoint low;
    ScenePoint high;
};

template <typename Heights, typename F>
class HeightfieldFacesNear {
public:
    HeightfieldFacesNear(const BasicHeightfieldSurface<Heights>& surface,
                         const SceneBounds& box,
                         std::uint32_t& looks,
                         F& function) noexcept
        : surface_(surface)
        , terrain_(*surface.terrain())
        , heights_(terrain_, surface.exaggeration())
        , box_(box)
        , looks_(looks)
        , function_(function)
    {}

    bool search() noexcept
    {
        double left = kFar;
        double right = -kFar;
        double upper = kFar;
        double lower = -kFar;
        for (const double x : {box_.low.x, box_.high.x}) {
            for (const double y : {box_.low.y, box_.high.y}) {
                const GridPoint grid = surface_.frame().toGrid({x, y, 0.0});
                left = std::min(left, grid.column);
                right = std::max(right, grid.column);
                upper = std::min(upper, grid.row);
                lower = std::max(lower, grid.row);
            }
        }
        const double columns = static_cast<double>(terrain_.columns() - 1);
        const double rows = static_cast<double>(terrain_.rows() - 1);
        if (!(right >= -kSlack && left <= columns + kSlack && lower >= -kSlack &&
              upper <= rows + kSlack)) {
            return true;
        }
        left_ = static_cast<std::int32_t>(std::clamp(left - kSlack, 0.0, columns - 1.0));
        right_ = static_cast<std::int32_t>(std::clamp(right + kSlack, 0.0, columns - 1.0));
        upper_ = static_cast<std::int32_t>(std::clamp(upper - kSlack, 0.0, rows - 1.0));
        lower_ = static_cast<std::int32_t>(std::clamp(lower + kSlack, 0.0, rows - 1.0));
        // From the level at which the box is at most as wide as a node: four nodes at most.
        std::size_t level = 0;
        while (level + 1 < terrain_.levelCount() &&
               ((right_ >> shift(level)) - (left_ >> shift(level)) > 1 ||
                (lower_ >> shift(level)) - (upper_ >> shift(level)) > 1)) {
            ++level;
        }
        for (std::int32_t row = upper_ >> shift(level); row <= lower_ >> shift(level); ++row) {
            for (std::int32_t column = left_ >> shift(level); column <= right_ >> shift(level);
                 ++column) {
                if (!visit(level, column, row)) {
                    return false;
                }
            }
        }
        return true;
    }

private:
    static constexpr double kFar = 1e300;
    static constexpr double kSlack = 1e-9; // cells

    static int shift(std::size_t level) noexcept
    {
        return static_cast<int>(level) + std::countr_zero(MinMaxPyramid::kBlock);
    }

    bool look() noexcept
    {
        if (looks_ == 0) {
            return false;
        }
        --looks_;
        return true;
    }

    bool visit(std::size_t level, std::int32_t column, std::int32_t row) noexcept
    {
        if (surface_.exaggeration() * terrain_.maximum(level, static_cast<std::size_t>(column),
                                                       static_cast<std::size_t>(row)) <
            box_.low.z) {
            return true;
        }
        if (!look()) {
            return false;
        }
        if (level == 0) {
            return visitCells(column << shift(0), row << shift(0));
        }
        const int below = shift(level - 1);
        for (std::int32_t r = std::max(2 * row, upper_ >> below);
             r <= std::min(2 * row + 1, lower_ >> below); ++r) {
            for (std::int32_t c = std::max(2 * column, left_ >> below);
                 c <= std::min(2 * column + 1, right_ >> below); ++c) {
                if (!visit(level - 1, c, r)) {
                    return false;
                }
            }
        }
        return true;
    }

    bool visitCells(std::int32_t left, std::int32_t upper) noexcept
    {
        constexpr auto kSide = static_cast<std::int32_t>(MinMaxPyramid::kBlock);
        const std::int32_t first = std::max(left, left_);
        const std::int32_t last = std::min(left + kSide - 1, right_);
        for (std::int32_t row = std::max(upper, upper_); row <= std::min(upper + kSide - 1, lower_);
             ++row) {
            double upper_right = heights_.at(first, row);
            double lower_right = heights_.at(first, row + 1);
            for (std::int32_t column = first; column <= last; ++column) {
                const double upper_left = upper_right;
                const double lower_left = lower_right;
                upper_right = heights_.at(column + 1, row);
                lower_right = heights_.at(column + 1, row + 1);
                if (!look()) {
                    return false;
                }
                const auto [lowest, highest] =
                    std::minmax({upper_left, upper_right, lower_left, lower_right});
                if (highest < box_.low.z || lowest > box_.high.z) {
                    continue;
                }
                for (const bool is_upper : {false, true}) {
                    const double third = is_upper ? upper_right : lower_left;
                    if (std::max({upper_left, third, lower_right}) >= box_.low.z &&
                        std::min({upper_left, third, lower_right}) <= box_.high.z &&
                        !report({column, row, is_upper}, {upper_left, third, lower_right})) {
                        return false;
                    }
                }
            }
        }
        return true;
    }

    // `z` of the upper left, the third and the lower right corner.
    bool report(const HeightfieldFace& face, const std::array<double, 3>& z) noexcept
    {
        std::array<ScenePoint, 3> corners;
        const auto vertices = surface_.corners(face);
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [column, row] = vertices[i];
            const std::size_t which =
                static_cast<std::size_t>((column - face.column) + (row - face.row));
            corners[i] = surface_.frame().toScene(
                {static_cast<double>(column), static_cast<double>(row)}, z[which]);
        }
        return function_(face, corners);
    }

    const BasicHeightfieldSurface<Heights>& surface_;
    const typename Heights::Terrain& terrain_;
    Heights heights_;
    const SceneBounds& box_;
    std::uint32_t& looks_;
    F& function_;
    std::int32_t left_ = 0;
    std::int32_t right_ = 0;
    std::int32_t upper_ = 0;
    std::int32_t lower_ = 0;
};

/// Calls function(face, corners) with each face that may intersect the box, excluding faces
/// entirely above or below it; the corners are in scene coordinates, in the order of S::corners.
/// Visits at most `looks` nodes and cells and subtracts the number visited from `looks`. False if
/// it stopped early, because the limit was reached or the function returned false. The hierarchy of
/// maxima skips everything entirely below the box. Allocates nothing.
template <typename Heights, typename F>
bool eachFaceNear(const BasicHeightfieldSurface<Heights>& surface,
                  const SceneBounds& box,
                  std::uint32_t& looks,
                  F&& function) noexcept
{
    return HeightfieldFacesNear<Heights, F>(surface, box, looks, function).search();
}

/// The same over a surface with its own search, as eachFaceNear(low, high, function).
template <typename S, typename F>
requires requires(const S& surface, const ScenePoint& p)
{
    surface.eachFaceNear(p, p, [](const typename S::Face&, const std::array<ScenePoint, 3>&) {});
}
bool eachFaceNear(const S& surface,
                  const SceneBounds& box,
                  std::uint32_t& looks,
                  F&& function) noexcept
{
    bool goes_on = true;
    surface.eachFaceNear(
        box.low, box.high,
        [&](const typename S::Face& face, const std::array<ScenePoint, 3>& corners) {
            if (goes_on && looks > 0) {
                --looks;
                goes_on = function(face, corners);
            } else {
                goes_on = false;
            }
            return goes_on;
        });
    return goes_on;
}

} // namespace marsview
