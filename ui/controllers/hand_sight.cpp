#include "ui/controllers/hand_sight.h"

#include "core/view/footprint.h"
#include "core/view/navigation.h"
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
    const Georeference& georeference = map.map->georeference();
    return {.frame = map.frame, .columns = georeference.columns(), .rows = georeference.rows()};
}

// Cells over the reach whose corners are probed.
constexpr std::size_t kProbeColumns = 32;
constexpr std::size_t kProbeRows = 24;
// Of the picture's width and height, on each side: the hand trails its aim by some millimeters, and
// the terrain between two probes may rise.
constexpr double kMarginShare = 0.06;

// Whether a probe is well inside the picture, and where.
struct Probe {
    bool is_inside = false;
    PixelPoint pixel;
};
using Probes =
    std::array<std::array<Probe, kProbeColumns + 1>, kProbeRows + 1>; // of cells' corners

struct CellRectangle {
    std::size_t column = 0;
    std::size_t row = 0;
    std::size_t columns = 0; // in cells
    std::size_t rows = 0;
};

// A corner of the cells over a rectangle, level with the device's origin.
WorkspacePoint probeIn(const WorkspaceBox& box, std::size_t column, std::size_t row)
{
    return {
        box.low.x + (box.high.x - box.low.x) * static_cast<double>(column) / kProbeColumns,
        box.low.y + (box.high.y - box.low.y) * static_cast<double>(row) / kProbeRows,
        0.0,
    };
}

// Pixels that a cell takes up in the picture: half the cross product of its diagonals.
double pixelsOf(const Probes& probes, std::size_t column, std::size_t row)
{
    const PixelPoint a = probes[row][column].pixel;
    const PixelPoint b = probes[row + 1][column + 1].pixel;
    const PixelPoint c = probes[row][column + 1].pixel;
    const PixelPoint d = probes[row + 1][column].pixel;
    return 0.5 * std::abs((b.x - a.x) * (d.y - c.y) - (b.y - a.y) * (d.x - c.x));
}

// Of cells all of whose corners are inside, the rectangle with the most pixels: in a tilted view
// the far terrain is wide, but small in the picture.
CellRectangle largestRectangle(const Probes& probes)
{
    CellRectangle best;
    double best_pixels = 0.0;
    for (std::size_t first = 0; first < kProbeRows; ++first) {
        // Of the cells from row `first` to `row` in each column; negative: one of them is outside.
        std::array<double, kProbeColumns> pixels{};
        for (std::size_t row = first; row < kProbeRows; ++row) {
            for (std::size_t column = 0; column < kProbeColumns; ++column) {
                const bool is_full = pixels[column] >= 0.0 && probes[row][column].is_inside &&
                                     probes[row][column + 1].is_inside &&
                                     probes[row + 1][column].is_inside &&
                                     probes[row + 1][column + 1].is_inside;
                pixels[column] = is_full ? pixels[column] + pixelsOf(probes, column, row) : -1.0;
            }
            std::size_t begin = 0;
            double sum = 0.0;
            for (std::size_t column = 0; column < kProbeColumns; ++column) {
                if (pixels[column] < 0.0) {
                    begin = column + 1;
                    sum = 0.0;
                    continue;
                }
                sum += pixels[column];
                if (sum > best_pixels) {
                    best_pixels = sum;
                    best = {begin, first, column - begin + 1, row - first + 1};
                }
            }
        }
    }
    return best;
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

// The rectangle within `reach` all of whose probes are well inside the picture.
std::optional<WorkspaceBox> probedSight(const OrbitCamera& camera,
                                        const Viewport& viewport,
                                        const SceneSurface& ground,
                                        double exaggeration,
                                        const WorkspaceFrame& frame,
                                        const WorkspaceBox& reach)
{
    const double left = kMarginShare * viewport.width;
    const double top = kMarginShare * viewport.height;
    const auto at = [&reach](std::size_t column, std::size_t row) {
        return probeIn(reach, column, row);
    };
    Probes probes{};
    for (std::size_t row = 0; row <= kProbeRows; ++row) {
        for (std::size_t column = 0; column <= kProbeColumns; ++column) {
            ScenePoint place = frame.toScene(at(column, row));
            place.z = ground.height(place.x, place.y) * exaggeration;
            const auto pixel =
                std::isfinite(place.z) ? project(camera, viewport, place) : std::nullopt;
            if (pixel) {
                const bool is_inside = pixel->x >= left && pixel->x <= viewport.width - left &&
                                       pixel->y >= top && pixel->y <= viewport.height - top;
                probes[row][column] = {is_inside, *pixel};
            }
        }
    }
    const CellRectangle found = largestRectangle(probes);
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

} // namespace

std::optional<WorkspaceBox> strokesInSight(const OrbitCamera& camera,
                                           const Viewport& viewport,
                                           const SceneSurface& ground,
                                           double exaggeration,
                                           const WorkspaceFrame& frame,
                                           const WorkspaceBox& reach)
{
    const auto probe = [&](const WorkspaceBox& within) {
        return probedSight(camera, viewport, ground, exaggeration, frame, within);
    };
    // Once more within what was found: on rough terrain a ridge between two probes may leave the
    // picture.
    const std::optional<WorkspaceBox> found = probe(reach);
    return found ? std::optional(probe(*found).value_or(*found)) : std::nullopt;
}

double highestTerrainIn(const WorkspaceBox& rectangle,
                        const SceneSurface& ground,
                        double exaggeration,
                        const WorkspaceFrame& frame)
{
    double highest = rectangle.low.z;
    for (std::size_t row = 0; row <= kProbeRows; ++row) {
        for (std::size_t column = 0; column <= kProbeColumns; ++column) {
            ScenePoint place = frame.toScene(probeIn(rectangle, column, row));
            place.z = ground.height(place.x, place.y) * exaggeration;
            if (std::isfinite(place.z)) {
                highest = std::max(highest, frame.toWorkspace(place).z);
            }
        }
    }
    return highest;
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
