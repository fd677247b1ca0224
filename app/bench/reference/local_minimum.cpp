#include "app/bench/reference/local_minimum.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace marsview {
namespace {

double cosine(const Vec3& a, const Vec3& b) noexcept
{
    const double lengths = length(a) * length(b);
    return lengths > 0.0 ? dot(a, b) / lengths : 0.0;
}

} // namespace

double steepestCosine(const HeightfieldSurface& surface,
                      const ScenePoint& proxy,
                      const ScenePoint& goal) noexcept
{
    const FilledHeightfield& terrain = *surface.terrain();
    const GridPoint grid = surface.frame().toGrid(proxy);
    const Vec3 to_goal = goal - proxy;
    // The tangent cone is the union, over the triangles that contain the proxy, of the spans of the
    // directions to their corners and the upward direction.
    double steepest = cosine(to_goal, {0.0, 0.0, 1.0});
    constexpr double kOn = 1e-10; // cells: on the border of a triangle
    const int near_c = static_cast<int>(std::floor(grid.column));
    const int near_r = static_cast<int>(std::floor(grid.row));
    for (int r = std::max(near_r - 1, 0);
         r <= std::min(near_r + 1, static_cast<int>(terrain.rows()) - 2); ++r) {
        for (int c = std::max(near_c - 1, 0);
             c <= std::min(near_c + 1, static_cast<int>(terrain.columns()) - 2); ++c) {
            const double u = grid.column - c;
            const double v = grid.row - r;
            if (u < -kOn || u > 1.0 + kOn || v < -kOn || v > 1.0 + kOn) {
                continue;
            }
            for (const bool is_upper : {true, false}) {
                if (is_upper ? u < v - kOn : u > v + kOn) {
                    continue;
                }
                const std::array<std::array<int, 2>, 3> corners{
                    {{c, r}, {c + 1, r + 1}, {is_upper ? c + 1 : c, is_upper ? r : r + 1}}};
                for (const auto& [column, row] : corners) {
                    const double height = terrain.sample(static_cast<std::size_t>(column),
                                                         static_cast<std::size_t>(row));
                    const Vec3 along = surface.frame().toScene(
                                           {static_cast<double>(column), static_cast<double>(row)},
                                           height * surface.exaggeration()) -
                                       proxy;
                    // A corner at the proxy itself gives only rounding error instead of a
                    // direction.
                    if (std::hypot(column - grid.column, row - grid.row) > 1e-7) {
                        steepest = std::max(steepest, cosine(to_goal, along));
                    }
                }
            }
        }
    }
    return steepest;
}

ScenePoint clampedGoal(const HeightfieldSurface& surface, const ScenePoint& goal) noexcept
{
    const GridPoint grid = surface.frame().toGrid(goal);
    const double last_column = static_cast<double>(surface.terrain()->columns() - 1);
    const double last_row = static_cast<double>(surface.terrain()->rows() - 1);
    if (grid.column >= 0.0 && grid.column <= last_column && grid.row >= 0.0 &&
        grid.row <= last_row) {
        return goal;
    }
    return surface.frame().toScene(
        {std::clamp(grid.column, 0.0, last_column), std::clamp(grid.row, 0.0, last_row)}, goal.z);
}

} // namespace marsview
