#include "app/bench/reference/local_minimum.h"

#include "core/contact/body_goal_frame.h"
#include "core/mesh/mesh_cast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

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

double steepestCosine(const BodyMesh& mesh,
                      const Georeference& georeference,
                      const ScenePoint& proxy,
                      const ScenePoint& goal)
{
    const BodyPositions& positions = mesh.positions();
    const BodyGoalFrame frame(positions.ellipsoid(), 1.0, Angle::degrees(0.0));
    const TracePoint at = frame.fromScene(proxy);
    const GeographicPoint place{.longitude = Angle::degrees(at.x),
                                .latitude = Angle::degrees(at.y)};
    const BodyPositions::Foot foot = footOf(positions.ellipsoid(), place);
    const Vec3 to_goal = goal - proxy;
    double steepest = cosine(to_goal, foot.normal);
    const auto consider = [&](BodyIndex face) {
        constexpr double kOn = 1e-9; // of the face's size
        const auto points = mesh.points(face);
        const double size =
            std::sqrt(std::max({dot(points[1] - points[0], points[1] - points[0]),
                                dot(points[2] - points[1], points[2] - points[1]),
                                dot(points[0] - points[2], points[0] - points[2])}));
        const std::array<double, 3> weights =
            nearestWeights(points[0] - proxy, points[1] - proxy, points[2] - proxy);
        const Vec3 rest = (points[0] - proxy) * weights[0] + (points[1] - proxy) * weights[1] +
                          (points[2] - proxy) * weights[2];
        constexpr double kRounding = 1e-14; // of coordinates
        if (length(rest) > kOn * size + kRounding * length(proxy)) {
            return;
        }
        for (const ScenePoint& corner : points) {
            const Vec3 along = corner - proxy;
            // A corner at the proxy itself gives only rounding error instead of a direction.
            if (length(along) > 1e-7 * size) {
                steepest = std::max(steepest, cosine(to_goal, along));
            }
        }
    };
    // Straight edges pass less than a cell from where the grid's lines are on the ellipsoid.
    const auto cell_columns =
        static_cast<std::int64_t>(positions.columns()) - (positions.wraps() ? 0 : 1);
    const auto cell_rows = static_cast<std::int64_t>(positions.rows()) - 1;
    const auto grid = georeference.toGrid(place);
    const auto column = static_cast<std::int64_t>(std::floor(grid ? grid->column : 0.0));
    const auto row = static_cast<std::int64_t>(std::floor(grid ? grid->row : 0.0)) -
                     static_cast<std::int64_t>(positions.firstRow());
    for (std::int64_t r = std::max<std::int64_t>(row - 1, 0); r <= std::min(row + 1, cell_rows - 1);
         ++r) {
        for (std::int64_t c = column - 1; c <= column + 1; ++c) {
            const std::int64_t turned = (c % cell_columns + cell_columns) % cell_columns;
            if (positions.wraps() || turned == c) {
                const auto face = static_cast<BodyIndex>(2 * (r * cell_columns + turned));
                consider(face);
                consider(face + 1);
            }
        }
    }
    if (row <= 0 || row + 1 >= cell_rows) { // the triangles that close the poles
        for (auto face = static_cast<BodyIndex>(2 * cell_columns * cell_rows);
             face < mesh.faceCount(); ++face) {
            consider(face);
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
