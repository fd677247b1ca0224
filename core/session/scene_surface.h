// The terrain of a scene: the surfaces of the maps that are shown together.
#pragma once

#include "core/session/map.h"
#include "core/terrain/ray_cast.h"
#include "core/view/camera.h"
#include "core/view/scene_box.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace marsview {

/// A map in the scene.
struct SceneMap {
    std::shared_ptr<const Map> map;
    SceneFrame frame; // from its grid to the scene
};

/// A point of the terrain.
struct GroundPoint {
    std::size_t index = 0;   // of the map, counted from the top
    GridPoint grid;          // of that map
    double height_m = 0.0;   // of the surface, not exaggerated
    double distance_m = 0.0; // along the ray
};

/// Maps on top of each other: at each position the terrain is that of the uppermost map with a
/// surface there. The scene uses the scene frame of the uppermost map. Immutable; copies share; any
/// thread.
class SceneSurface {
public:
    SceneSurface() = default;
    /// The uppermost first. All lie in one CRS.
    explicit SceneSurface(const std::vector<std::shared_ptr<const Map>>& maps);

    bool isEmpty() const noexcept { return maps_.empty(); }
    const std::vector<SceneMap>& maps() const noexcept { return maps_; }

    /// The first hit of a ray on the terrain, at full resolution; for a tiled map, at the finest
    /// resident level.
    std::optional<GroundPoint> cast(const Ray& ray, double exaggeration) const;
    /// Height of the terrain in meters, for a tiled map from the resident tiles; NaN outside the
    /// maps and in voids. The outermost samples belong to the terrain regardless of rounding.
    double height(double east_m, double north_m) const;
    /// The map with that surface; empty without terrain there.
    std::optional<std::size_t> mapAt(double east_m, double north_m) const;
    /// Around all maps.
    SceneBox box(double exaggeration) const;
    /// Boxes around parts of the maps, some hundred at most: all terrain lies in them. Empty
    /// without terrain.
    std::vector<SceneBox> partBoxes(double exaggeration) const;
    /// The smallest pixel side in meters.
    double pixelMeters() const;

private:
    bool isCovered(const ScenePoint& place, std::size_t index) const;
    double heightOf(const SceneMap& map, double east_m, double north_m) const;

    std::vector<SceneMap> maps_;
};

/// The frame that maps the grid of `map` into the scene of `scene`: through their common map
/// coordinates, on the turn of longitude that brings the two together.
SceneFrame frameWithin(const Georeference& scene, const Georeference& map);

} // namespace marsview
