// The definitions of body_below.h, for the files that instantiate surfaces on a body.
#pragma once

#include "core/contact/body_below.h"
#include "core/contact/mesh_surface_definitions.h"
#include "core/mesh/mesh_cast_definitions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace marsview::body_below {

template <typename Mesh>
double clearanceOver(const BasicMeshSurface<Mesh>& surface, const ScenePoint& point) noexcept
{
    const Mesh& mesh = *surface.mesh();
    const Ellipsoid& body = mesh.ellipsoid();
    const BodyVertical vertical = verticalAt(body, point);
    // Below all terrain, and not beyond the middle of the body, from where the far side is above.
    constexpr double kDepthShare = 0.9;
    const double depth_m = kDepthShare * std::min(body.equatorial_m, body.polar_m);
    const auto from = surface.goal(mesh.highAbove(point));
    const auto to = surface.goal(point - vertical.up * (vertical.height_m + depth_m));
    if (!from || !to) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    const auto cast = surface.castFree(*from, *to);
    return cast.contact ? dot(point - surface.point(*cast.contact), vertical.up)
                        : std::numeric_limits<double>::quiet_NaN();
}

template <typename Mesh>
BodyBelow
belowOn(const BasicMeshSurface<Mesh>& surface, const ScenePoint& point, double level_m) noexcept
{
    const Mesh& mesh = *surface.mesh();
    const Ellipsoid& body = mesh.ellipsoid();
    const double clearance_m = clearanceOver(surface, point);
    const BodyVertical vertical = verticalAt(body, point);
    if (std::isfinite(clearance_m) || !surface.goal(point)) {
        return {
            .over = point, .clearance_m = clearance_m, .level_m = vertical.height_m - clearance_m};
    }
    // The place of the border that is nearest at its own height. From far above or below the search
    // would take long.
    ScenePoint at = point + vertical.up * (level_m - vertical.height_m);
    ScenePoint border;
    constexpr int kRounds = 2;
    for (int i = 0; i < kRounds; ++i) {
        const auto place = nearestPlace(mesh, at);
        const auto corners = mesh.points(place.face);
        // A little inside, where a cast finds the surface.
        constexpr double kInside = 1e-6;
        border = {};
        for (std::size_t k = 0; k < corners.size(); ++k) {
            border = border + corners[k] * ((1.0 - kInside) * place.weights[k] + kInside / 3.0);
        }
        at = point - vertical.up * dot(point - border, vertical.up);
    }
    const BodyVertical there = verticalAt(body, border);
    const double rise_m = vertical.height_m - there.height_m;
    const ScenePoint over = border + there.up * rise_m;
    const double found_m = clearanceOver(surface, over);
    return {.over = over,
            .clearance_m = std::isfinite(found_m) ? found_m : rise_m,
            .level_m = there.height_m,
            .is_beside = true};
}

} // namespace marsview::body_below
