#include "haptics/interaction/body_frame.h"

#include "core/contact/body_below.h"
#include "core/globe/body_camera.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace marsview {
namespace {

WorkspaceFrame onBody(const WorkspaceFrame& over_site, const Vec3& foot, const Rotation& axes)
{
    return {.anchor = over_site.anchor,
            .place = foot + axes * over_site.place,
            .scene_per_meter = over_site.scene_per_meter,
            .body_axes = axes};
}

// Some of the samples on the half of the body that faces up.
SceneBox boundsOf(const BodyMesh& mesh, const Vec3& foot, const Rotation& axes)
{
    constexpr double kFar = std::numeric_limits<double>::infinity();
    SceneBox box{.minimum = {kFar, kFar, kFar}, .maximum = {-kFar, -kFar, -kFar}};
    const std::size_t columns = mesh.positions().columns();
    const std::size_t rows = mesh.positions().rows();
    const auto steps = [](std::size_t count) { return std::min<std::size_t>(count, 128); };
    const auto at = [&steps](std::size_t i, std::size_t count) {
        return count > 1 ? i * (count - 1) / (steps(count) - 1) : 0;
    };
    const Rotation to_site = axes.inverse();
    for (std::size_t r = 0; r < steps(rows); ++r) {
        for (std::size_t c = 0; c < steps(columns); ++c) {
            const ScenePoint point = mesh.vertex(BodyIndex{at(r, rows)} * columns + at(c, columns));
            if (dot(point, axes.z) < 0.0) {
                continue;
            }
            const Vec3 seen = to_site * (point - foot);
            box.minimum = {std::min(box.minimum.x, seen.x), std::min(box.minimum.y, seen.y),
                           std::min(box.minimum.z, seen.z)};
            box.maximum = {std::max(box.maximum.x, seen.x), std::max(box.maximum.y, seen.y),
                           std::max(box.maximum.z, seen.z)};
        }
    }
    return box;
}

} // namespace

Rotation axesAt(const Ellipsoid& body, const BodySite& site)
{
    const LocalAxes local = localAxes(body, site.place);
    const double sine = std::sin(site.heading.radians());
    const double cosine = std::cos(site.heading.radians());
    return {local.east * cosine - local.north * sine, local.north * cosine + local.east * sine,
            local.up};
}

WorkspaceFrame frameOverSite(const Ellipsoid& body,
                             const BodySite& site,
                             const SceneBox& box,
                             const WorkspaceBox& reach)
{
    return onBody(frameForMap(box, reach), footOf(body, site.place).surface_m, axesAt(body, site));
}

WorkspaceFrame frameForBodyMap(const std::shared_ptr<const BodyMesh>& mesh,
                               const Georeference& georeference,
                               const WorkspaceBox& reach,
                               std::optional<double> width_m)
{
    const Ellipsoid& body = mesh->positions().ellipsoid();
    const auto middle =
        georeference.toGeographic({0.5 * static_cast<double>(georeference.columns() - 1),
                                   0.5 * static_cast<double>(georeference.rows() - 1)});
    const BodySite site{.place = middle.value_or(GeographicPoint{})};
    const Vec3 foot = footOf(body, site.place).surface_m;
    const Rotation axes = axesAt(body, site);
    WorkspaceFrame over_site = frameForMap(boundsOf(*mesh, foot, axes), reach);
    if (width_m) {
        over_site.place = {0.0, 0.0, -belowOn(BodySurface(mesh), foot).clearance_m};
        over_site.scene_per_meter = *width_m / (reach.high.x - reach.low.x);
    }
    return onBody(over_site, foot, axes);
}

} // namespace marsview
