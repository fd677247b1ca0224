#include "haptics/interaction/workspace_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace marsview {
namespace {

// Counterclockwise about the vertical.
Vec3 turnedBy(const Vec3& v, Angle angle) noexcept
{
    const double c = std::cos(angle.radians());
    const double s = std::sin(angle.radians());
    return {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

WorkspacePoint centerOf(const WorkspaceBox& box) noexcept
{
    return {0.5 * (box.low.x + box.high.x), 0.5 * (box.low.y + box.high.y),
            0.5 * (box.low.z + box.high.z)};
}

// The bounds of rotated points.
struct Bounds {
    Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), 0.0};
    Vec3 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
              0.0};
    void add(const Vec3& p) noexcept
    {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), 0.0};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), 0.0};
    }
};

double share(double scene_m, double workspace_m) noexcept
{
    return workspace_m > 0.0 ? scene_m / workspace_m : 0.0;
}

// `low` and `high` are in scene meters along the workspace's axes.
WorkspaceFrame frameAround(const Vec3& low, const Vec3& high, Angle turn, const WorkspaceBox& reach)
{
    const Vec3 size = reach.high - reach.low;
    const Vec3 extent = high - low;
    const double scale =
        std::max({share(extent.x, size.x), share(extent.y, size.y), share(extent.z, size.z)});
    return {.anchor = centerOf(reach),
            .place = turnedBy((low + high) * 0.5, turn),
            .scene_per_meter = scale > 0.0 ? scale : 1.0,
            .turn = turn};
}

} // namespace

ScenePoint WorkspaceFrame::toScene(const WorkspacePoint& point) const noexcept
{
    const Vec3 along = point - anchor;
    return body_axes ? place + differenceToScene(along)
                     : place + turnedBy(along, turn) * scene_per_meter;
}

WorkspacePoint WorkspaceFrame::toWorkspace(const ScenePoint& point) const noexcept
{
    return anchor + differenceToWorkspace(point - place);
}

Vec3 WorkspaceFrame::differenceToWorkspace(const Vec3& scene_m) const noexcept
{
    const Vec3 along = body_axes ? body_axes->inverse() * scene_m : turnedBy(scene_m, -turn);
    return along * (1.0 / scene_per_meter);
}

Vec3 WorkspaceFrame::differenceToScene(const Vec3& workspace_m) const noexcept
{
    return (body_axes ? *body_axes * workspace_m : turnedBy(workspace_m, turn)) * scene_per_meter;
}

WorkspaceFrame WorkspaceFrame::panned(const Vec3& shift) const noexcept
{
    WorkspaceFrame result = *this;
    result.place = place - differenceToScene(shift);
    return result;
}

WorkspaceFrame WorkspaceFrame::zoomed(const WorkspacePoint& fixed, double factor) const noexcept
{
    return {.anchor = fixed,
            .place = toScene(fixed),
            .scene_per_meter = scene_per_meter / factor,
            .turn = turn,
            .body_axes = body_axes};
}

WorkspaceFrame WorkspaceFrame::turned(const WorkspacePoint& fixed, Angle angle) const noexcept
{
    if (body_axes) {
        return {.anchor = fixed,
                .place = toScene(fixed),
                .scene_per_meter = scene_per_meter,
                .body_axes =
                    (*body_axes * Rotation::by({0.0, 0.0, -angle.radians()})).orthonormal()};
    }
    return {.anchor = fixed,
            .place = toScene(fixed),
            .scene_per_meter = scene_per_meter,
            .turn = turn + -angle};
}

WorkspaceFrame WorkspaceFrame::moved(const WorkspaceFrame& from,
                                     const WorkspaceFrame& to) const noexcept
{
    if (*this == from) {
        return to;
    }
    WorkspaceFrame result{.anchor = anchor,
                          .place = to.toScene(from.toWorkspace(place)),
                          .scene_per_meter =
                              scene_per_meter * to.scene_per_meter / from.scene_per_meter,
                          .turn = turn + to.turn + -from.turn};
    if (body_axes && from.body_axes && to.body_axes) {
        result.body_axes = (*to.body_axes * from.body_axes->inverse() * *body_axes).orthonormal();
    }
    return result;
}

SceneMotion WorkspaceFrame::motionFrom(const WorkspaceFrame& from) const noexcept
{
    SceneMotion motion{.from = from.place,
                       .to = toScene(from.anchor),
                       .scale = scene_per_meter / from.scene_per_meter,
                       .turn_rad = (turn + -from.turn).radians()};
    if (body_axes && from.body_axes) {
        motion.body_turn_rad = (*body_axes * from.body_axes->inverse()).turn();
    }
    return motion;
}

WorkspaceFrame WorkspaceFrame::after(const SceneMotion& motion) const noexcept
{
    if (body_axes.has_value() != motion.body_turn_rad.has_value()) {
        return *this;
    }
    if (body_axes) {
        const Rotation by = Rotation::by(*motion.body_turn_rad);
        return {.anchor = anchor,
                .place = motion.to + by * (place - motion.from) * motion.scale,
                .scene_per_meter = scene_per_meter * motion.scale,
                .body_axes = (by * *body_axes).orthonormal()};
    }
    const Angle by = Angle::radians(motion.turn_rad);
    return {.anchor = anchor,
            .place = motion.to + turnedBy(place - motion.from, by) * motion.scale,
            .scene_per_meter = scene_per_meter * motion.scale,
            .turn = turn + by};
}

SceneMotion combined(const SceneMotion& first, const SceneMotion& last) noexcept
{
    WorkspaceFrame begin;
    if (last.body_turn_rad) {
        begin.body_axes = Rotation{};
    }
    return begin.after(first).after(last).motionFrom(begin);
}

bool WorkspaceFrame::isSound() const noexcept
{
    const double sum = anchor.x + anchor.y + anchor.z + place.x + place.y + place.z +
                       scene_per_meter + turn.radians();
    return std::isfinite(sum) && scene_per_meter > 0.0 &&
           (!body_axes ||
            (isFinite(body_axes->x) && isFinite(body_axes->y) && isFinite(body_axes->z)));
}

WorkspaceFrame frameForView(const OrbitCamera& camera,
                            const Viewport& viewport,
                            const MapPlan& map,
                            const SceneBox& box,
                            const WorkspaceBox& reach)
{
    const Angle turn = -camera.azimuth; // headings are clockwise
    Bounds bounds;
    const std::vector<GridPoint> corners = footprint(camera, viewport, map);
    for (const GridPoint& corner : corners) {
        bounds.add(turnedBy(map.frame.toScene(corner, 0.0), -turn));
    }
    if (corners.empty()) {
        const Vec3 target = turnedBy(camera.target, -turn);
        bounds.add(target + Vec3{camera.distance_m, camera.distance_m, 0.0} * 0.5);
        bounds.add(target - Vec3{camera.distance_m, camera.distance_m, 0.0} * 0.5);
    }
    bounds.low.z = box.minimum.z;
    bounds.high.z = box.maximum.z;
    return frameAround(bounds.low, bounds.high, turn, reach);
}

WorkspaceFrame frameForMap(const SceneBox& box, const WorkspaceBox& reach) noexcept
{
    return frameAround(box.minimum, box.maximum, Angle{}, reach);
}

} // namespace marsview
