#include "ui/controllers/hand_sight.h"

#include "core/view/footprint.h"
#include "core/view/navigation.h"
#include "haptics/interaction/stroke_area.h"
#include "haptics/interaction/workspace_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace marsview {
namespace {

constexpr int kProbesPerSide = 24;

// Above and below the ground that is seen: to hover over it and to press into it.
constexpr double kRoomShare = 0.15;
constexpr double kRoomOfWidth = 0.03;

MapPlan planOf(const SceneMap& map)
{
    const Georeference& georeference = map.map->georeference();
    return {.frame = map.frame, .columns = georeference.columns(), .rows = georeference.rows()};
}

// The same picture, its target on the terrain in the middle: the box's floor, at which a view of
// the whole map is aimed, may be far below.
OrbitCamera onGround(const OrbitCamera& camera, const SceneSurface& ground, double exaggeration)
{
    constexpr double kFarthest = 4.0; // of the distance: further is the horizon
    const auto hit =
        ground.cast({.origin = eyeOf(camera), .direction = axesOf(camera).forward}, exaggeration);
    const bool is_near =
        hit && hit->distance_m > 0.0 && hit->distance_m < kFarthest * camera.distance_m;
    return is_near ? retargeted(camera, hit->distance_m) : camera;
}

} // namespace

std::optional<WorkspaceBox> strokesInSight(const OrbitCamera& camera,
                                           const Viewport& viewport,
                                           const SceneSurface& ground,
                                           double exaggeration,
                                           const WorkspaceFrame& frame,
                                           const WorkspaceBox& reach)
{
    return strokeArea(reach, viewport, [&](const WorkspacePoint& at) {
        ScenePoint place = frame.toScene(at);
        place.z = ground.height(place.x, place.y) * exaggeration;
        return std::isfinite(place.z) ? project(camera, viewport, place) : std::nullopt;
    });
}

double highestTerrainIn(const WorkspaceBox& rectangle,
                        const SceneSurface& ground,
                        double exaggeration,
                        const WorkspaceFrame& frame)
{
    return highestIn(rectangle, [&](const WorkspacePoint& at) {
        ScenePoint place = frame.toScene(at);
        place.z = ground.height(place.x, place.y) * exaggeration;
        return frame.toWorkspace(place).z;
    });
}

WorkspaceFrame frameForSight(const OrbitCamera& sight,
                             const Viewport& viewport,
                             const SceneSurface& ground,
                             double exaggeration,
                             const WorkspaceBox& walls)
{
    const OrbitCamera camera = onGround(sight, ground, exaggeration);
    const MapPlan plan = planOf(ground.maps().front());
    SceneBox box = ground.box(exaggeration);
    const WorkspaceBox reach = reachWithin(walls);
    const std::vector<GridPoint> seen = footprint(camera, viewport, plan);
    if (seen.empty()) {
        return frameForView(camera, viewport, plan, box, reach);
    }
    GridPoint low = seen.front();
    GridPoint high = seen.front();
    for (const GridPoint& corner : seen) {
        low = {std::min(low.column, corner.column), std::min(low.row, corner.row)};
        high = {std::max(high.column, corner.column), std::max(high.row, corner.row)};
    }
    double lowest_m = std::numeric_limits<double>::infinity();
    double highest_m = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < kProbesPerSide * kProbesPerSide; ++i) {
        const auto along = [](double from, double to, int step) {
            return from + (to - from) * step / (kProbesPerSide - 1);
        };
        const ScenePoint place =
            plan.frame.toScene({along(low.column, high.column, i % kProbesPerSide),
                                along(low.row, high.row, i / kProbesPerSide)},
                               0.0);
        const double z_m = ground.height(place.x, place.y) * exaggeration;
        if (std::isfinite(z_m)) {
            lowest_m = std::min(lowest_m, z_m);
            highest_m = std::max(highest_m, z_m);
        }
    }
    if (lowest_m <= highest_m) {
        const Vec3 across = plan.frame.toScene(high, 0.0) - plan.frame.toScene(low, 0.0);
        const double room_m =
            kRoomShare * (highest_m - lowest_m) + kRoomOfWidth * std::hypot(across.x, across.y);
        box.minimum.z = lowest_m - room_m;
        box.maximum.z = highest_m + room_m;
    }
    return frameForView(camera, viewport, plan, box, reach);
}

} // namespace marsview
