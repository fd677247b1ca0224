#include "core/contact/body_surface.h"

#include "core/contact/mesh_surface_definitions.h"
#include "core/mesh/mesh_cast_definitions.h"

#include <algorithm>
#include <limits>

namespace marsview {

template class BasicMeshSurface<BodyMesh>;

double clearanceOver(const BodySurface& surface, const ScenePoint& point) noexcept
{
    const BodyMesh& mesh = *surface.mesh();
    const Ellipsoid& body = mesh.positions().ellipsoid();
    const BodyVertical vertical = verticalAt(body, point);
    // Below all terrain, and not beyond the middle of the body, from where the far side is above.
    constexpr double kDepthShare = 0.9;
    const double depth_m = kDepthShare * std::min(body.equatorial_m, body.polar_m);
    const auto from = surface.goal(mesh.highAbove(point));
    const auto to = surface.goal(point - vertical.up * (vertical.height_m + depth_m));
    if (!from || !to) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    const BodySurface::Cast cast = surface.castFree(*from, *to);
    return cast.contact ? dot(point - surface.point(*cast.contact), vertical.up)
                        : std::numeric_limits<double>::quiet_NaN();
}

} // namespace marsview
