// The border of a surface as planes, for models that see only the faces that they meet.
#pragma once

#include "core/base/vec.h"
#include "core/contact/heightfield_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace marsview {

/// A vertical plane that the proxy cannot cross.
struct BorderWall {
    Vec3 normal; // inward, of length 1
    ScenePoint on;

    /// In meters; negative beyond the wall.
    double distance(const ScenePoint& p) const noexcept { return dot(normal, p - on); }
};

struct BorderWalls {
    std::array<BorderWall, 4> walls;
    std::size_t count = 0;
    double tolerance_m = 0.0; // rounding error of a position on a wall

    const BorderWall* begin() const noexcept { return walls.data(); }
    const BorderWall* end() const noexcept { return walls.data() + count; }
};

/// Four around a heightfield.
template <typename Heights>
BorderWalls borderWalls(const BasicHeightfieldSurface<Heights>& surface) noexcept
{
    const double last_column = static_cast<double>(surface.terrain()->columns() - 1);
    const double last_row = static_cast<double>(surface.terrain()->rows() - 1);
    const auto at = [&](double column, double row) {
        return surface.frame().toScene({column, row}, 0.0);
    };
    const std::array<ScenePoint, 4> corners{at(0.0, 0.0), at(last_column, 0.0),
                                            at(last_column, last_row), at(0.0, last_row)};
    const ScenePoint middle = at(0.5 * last_column, 0.5 * last_row);
    BorderWalls walls;
    double reach = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 along = corners[(i + 1) % 4] - corners[i];
        Vec3 normal = normalized(Vec3{-along.y, along.x, 0.0});
        if (dot(normal, middle - corners[i]) < 0.0) {
            normal = -normal;
        }
        walls.walls[walls.count++] = {normal, corners[i]};
        reach = std::max({reach, std::abs(corners[i].x), std::abs(corners[i].y)});
    }
    walls.tolerance_m = 32.0 * std::numeric_limits<double>::epsilon() * reach;
    return walls;
}

/// None around a surface that the proxy may fall off.
template <typename S>
requires(!S::kIsBorderWall) BorderWalls borderWalls(const S& /*surface*/)
noexcept
{
    return {};
}

} // namespace marsview
