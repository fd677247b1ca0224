#include "core/session/scene_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace marsview {
namespace {

// A ray may pass this many covered surfaces of one map: more than a picture has columns.
constexpr int kCoveredMax = 4096;

// Behind a covered hit the ray restarts this fraction of its length further along.
constexpr double kStep = 1e-9;

// The offset to add to the map coordinate x of `map` to reach the turn of longitude on which
// `scene` has the same position.
double turnsBetween(const Georeference& scene, const Georeference& map, GridPoint center)
{
    const auto turn = scene.crs() ? scene.crs()->turn() : std::nullopt;
    const auto place = turn ? map.toGeographic(center) : std::nullopt;
    const auto there = place ? scene.toGrid(*place) : std::nullopt;
    return there ? *turn * std::round((scene.toMap(*there).x - map.toMap(center).x) / *turn) : 0.0;
}

} // namespace

SceneFrame frameWithin(const Georeference& scene, const Georeference& map)
{
    const GridPoint center{static_cast<double>(map.columns() - 1) / 2.0,
                           static_cast<double>(map.rows() - 1) / 2.0};
    const double turns_x = turnsBetween(scene, map, center);
    const auto onto_scene = [&](GridPoint grid) {
        const MapPoint at = map.toMap(grid);
        // Not Georeference::toGrid(), which rounds: samples of the map may be much smaller.
        return scene.sceneFrame().toScene(scene.transform().toGrid({at.x + turns_x, at.y}), 0.0);
    };
    // Computed over the whole map, because errors are multiplied by its columns.
    const double last_column = static_cast<double>(map.columns() - 1);
    const double last_row = static_cast<double>(map.rows() - 1);
    const ScenePoint first = onto_scene({0.0, 0.0});
    const Vec3 column = (onto_scene({last_column, 0.0}) - first) * (1.0 / last_column);
    const Vec3 row = (onto_scene({0.0, last_row}) - first) * (1.0 / last_row);
    SceneFrame result{.origin = {},
                      .east_per_column = column.x,
                      .east_per_row = row.x,
                      .north_per_column = column.y,
                      .north_per_row = row.y};
    // The center keeps its position in the scene.
    const ScenePoint at = onto_scene(center);
    const GridPoint back = result.toGrid({-at.x, -at.y, 0.0});
    result.origin = {center.column + back.column, center.row + back.row};
    return result;
}

SceneSurface::SceneSurface(const std::vector<std::shared_ptr<const Map>>& maps)
{
    for (const std::shared_ptr<const Map>& map : maps) {
        const Georeference& georeference = map->georeference();
        maps_.push_back({.map = map,
                         .frame = maps_.empty() ? georeference.sceneFrame()
                                                : frameWithin(maps_.front().map->georeference(),
                                                              georeference)});
    }
}

std::optional<GroundPoint> SceneSurface::cast(const Ray& ray, double exaggeration) const
{
    std::optional<GroundPoint> nearest;
    for (std::size_t index = 0; index < maps_.size(); ++index) {
        const SceneMap& part = maps_[index];
        const Heightfield& heightfield = part.map->heightfield();
        double from_m = 0.0;
        for (int i = 0; i < kCoveredMax; ++i) {
            const auto hit =
                castRay(heightfield, part.map->analysis()->bounds,
                        gridRay(ray.at(from_m), ray.direction, part.frame, exaggeration));
            if (!hit || (nearest && from_m + hit->t >= nearest->distance_m)) {
                break;
            }
            const double distance_m = from_m + hit->t;
            if (!isCovered(part.frame.toScene(hit->grid, 0.0), index)) {
                nearest = GroundPoint{.index = index,
                                      .grid = hit->grid,
                                      .height_m = hit->height_m,
                                      .distance_m = distance_m};
                break;
            }
            from_m = distance_m * (1.0 + kStep) + std::numeric_limits<double>::min();
        }
    }
    return nearest;
}

double SceneSurface::height(double east_m, double north_m) const
{
    for (const SceneMap& part : maps_) {
        const double height_m = heightOf(part, east_m, north_m);
        if (!std::isnan(height_m)) {
            return height_m;
        }
    }
    return std::numeric_limits<double>::quiet_NaN();
}

std::optional<std::size_t> SceneSurface::mapAt(double east_m, double north_m) const
{
    for (std::size_t index = 0; index < maps_.size(); ++index) {
        if (!std::isnan(heightOf(maps_[index], east_m, north_m))) {
            return index;
        }
    }
    return std::nullopt;
}

SceneBox SceneSurface::box(double exaggeration) const
{
    SceneBox box;
    for (const SceneMap& part : maps_) {
        const Heightfield& heightfield = part.map->heightfield();
        const SceneBox more = sceneBox(part.frame, heightfield.columns(), heightfield.rows(),
                                       heightfield.range().value_or(HeightRange{}), exaggeration);
        box = &part == &maps_.front() ? more : united(box, more);
    }
    return box;
}

std::vector<SceneBox> SceneSurface::partBoxes(double exaggeration) const
{
    constexpr std::size_t kPartsMax = 16; // along a side of a map
    std::vector<SceneBox> boxes;
    for (const SceneMap& part : maps_) {
        const MinMaxPyramid& bounds = part.map->analysis()->bounds;
        std::size_t level = 0;
        while (std::max(bounds.columns(level), bounds.rows(level)) > kPartsMax) {
            ++level;
        }
        const std::size_t cells = MinMaxPyramid::kBlock << level;
        const std::size_t last_column = part.map->heightfield().columns() - 1;
        const std::size_t last_row = part.map->heightfield().rows() - 1;
        for (std::size_t row = 0; row < bounds.rows(level); ++row) {
            for (std::size_t column = 0; column < bounds.columns(level); ++column) {
                const MinMaxPyramid::Bounds heights = bounds.bounds(level, column, row);
                if (!heights.isEmpty()) {
                    boxes.push_back(boxAround(
                        part.frame,
                        {static_cast<double>(column * cells), static_cast<double>(row * cells)},
                        {static_cast<double>(std::min((column + 1) * cells, last_column)),
                         static_cast<double>(std::min((row + 1) * cells, last_row))},
                        {heights.minimum_m, heights.maximum_m}, exaggeration));
                }
            }
        }
    }
    return boxes;
}

double SceneSurface::pixelMeters() const
{
    double pixel_m = std::numeric_limits<double>::infinity();
    for (const SceneMap& part : maps_) {
        const Georeference& georeference = part.map->georeference();
        pixel_m =
            std::min({pixel_m, georeference.pixelWidthMeters(), georeference.pixelHeightMeters()});
    }
    return pixel_m;
}

bool SceneSurface::isCovered(const ScenePoint& place, std::size_t index) const
{
    return std::any_of(
        maps_.begin(), maps_.begin() + static_cast<std::ptrdiff_t>(index),
        [&](const SceneMap& above) { return !std::isnan(heightOf(above, place.x, place.y)); });
}

double SceneSurface::heightOf(const SceneMap& map, double east_m, double north_m) const
{
    const Heightfield& heightfield = map.map->heightfield();
    const auto on_edge = [](double place, std::size_t count) {
        const double nearest = std::clamp(place, 0.0, static_cast<double>(count - 1));
        return std::abs(nearest - place) < 1e-6 ? nearest : place;
    };
    const GridPoint grid = map.frame.toGrid({east_m, north_m, 0.0});
    return heightfield.heightNow(
        {on_edge(grid.column, heightfield.columns()), on_edge(grid.row, heightfield.rows())});
}

} // namespace marsview
