#include "ui/hand_sight.h"

#include "core/view/footprint.h"
#include "haptics/interaction/workspace_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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
    const Georeference& georeference = map.map.dataset->georeference();
    return {.frame = map.frame, .columns = georeference.columns(), .rows = georeference.rows()};
}

// A mask of cells over the reach, row by row.
constexpr int kMaskColumns = 32;
constexpr int kMaskRows = 24;
// Of the picture's width and height, on each side: the hand trails its aim by some millimetres, and
// the terrain between two probes may rise.
constexpr double kMarginShare = 0.06;

using Mask = std::array<std::array<bool, kMaskColumns + 1>, kMaskRows + 1>; // of the cells' corners

struct MaskRectangle {
    int column = 0;
    int row = 0;
    int columns = 0; // in cells
    int rows = 0;
};

// The largest rectangle of cells all of whose corners are set.
MaskRectangle largestRectangle(const Mask& mask)
{
    MaskRectangle best;
    std::array<int, kMaskColumns> heights{}; // of the full cells that end in this row
    for (int row = 0; row < kMaskRows; ++row) {
        const auto below = static_cast<std::size_t>(row);
        for (std::size_t column = 0; column < heights.size(); ++column) {
            const bool is_full = mask[below][column] && mask[below][column + 1] &&
                                 mask[below + 1][column] && mask[below + 1][column + 1];
            heights[column] = is_full ? heights[column] + 1 : 0;
        }
        for (int first = 0; first < kMaskColumns; ++first) {
            int height = kMaskRows;
            for (int last = first; last < kMaskColumns; ++last) {
                height = std::min(height, heights[static_cast<std::size_t>(last)]);
                if (height * (last - first + 1) > best.columns * best.rows) {
                    best = {first, row - height + 1, last - first + 1, height};
                }
            }
        }
    }
    return best;
}

} // namespace

std::optional<WorkspaceBox> strokesInSight(const OrbitCamera& camera,
                                           const Viewport& viewport,
                                           const SceneSurface& ground,
                                           double exaggeration,
                                           const WorkspaceFrame& frame,
                                           const WorkspaceBox& reach)
{
    const double left = kMarginShare * viewport.width;
    const double top = kMarginShare * viewport.height;
    const auto at = [&reach](double column, double row) {
        return WorkspacePoint{
            reach.low.x + (reach.high.x - reach.low.x) * column / kMaskColumns,
            reach.low.y + (reach.high.y - reach.low.y) * row / kMaskRows,
            0.0,
        };
    };
    Mask mask{};
    for (std::size_t row = 0; row < mask.size(); ++row) {
        for (std::size_t column = 0; column < mask[row].size(); ++column) {
            ScenePoint place =
                frame.toScene(at(static_cast<double>(column), static_cast<double>(row)));
            place.z = ground.height(place.x, place.y) * exaggeration;
            const auto pixel =
                std::isfinite(place.z) ? project(camera, viewport, place) : std::nullopt;
            mask[row][column] = pixel && pixel->x >= left && pixel->x <= viewport.width - left &&
                                pixel->y >= top && pixel->y <= viewport.height - top;
        }
    }
    const MaskRectangle found = largestRectangle(mask);
    if (found.columns == 0) {
        return std::nullopt;
    }
    WorkspaceBox strokes = reach;
    const WorkspacePoint low = at(found.column, found.row);
    const WorkspacePoint high = at(found.column + found.columns, found.row + found.rows);
    strokes.low.x = low.x;
    strokes.low.y = low.y;
    strokes.high.x = high.x;
    strokes.high.y = high.y;
    return strokes;
}

WorkspaceFrame frameForSight(const OrbitCamera& camera,
                             const Viewport& viewport,
                             const SceneSurface& ground,
                             double exaggeration,
                             const WorkspaceBox& walls)
{
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
