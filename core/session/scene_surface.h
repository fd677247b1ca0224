// The ground of a scene: the surfaces of the maps that are shown together.
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

/// A point of the ground.
struct GroundPoint {
    std::size_t index = 0;   // of the map, counted from the top
    GridPoint grid;          // of that map
    double height_m = 0.0;   // of the surface, not exaggerated
    double distance_m = 0.0; // along the ray
};

/// Maps on top of each other: at each place the ground is the uppermost map that has a surface
/// there. The uppermost map's scene frame is the scene's. Immutable; copies share; any thread.
class SceneSurface {
public:
    SceneSurface() = default;
    /// The uppermost first. All lie in one CRS.
    explicit SceneSurface(const std::vector<std::shared_ptr<const Map>>& maps);

    bool isEmpty() const noexcept { return maps_.empty(); }
    const std::vector<SceneMap>& maps() const noexcept { return maps_; }

    /// Where a ray first meets the ground, at full resolution; of a map in tiles, at the finest
    /// that is there.
    std::optional<GroundPoint> cast(const Ray& ray, double exaggeration) const;
    /// Height of the ground in metres, of a map in tiles by what is there; NaN where there is none.
    /// The outermost samples are ground, whatever rounding makes of a place on them.
    double height(double east_m, double north_m) const;
    /// The map whose surface that is; nothing where there is no ground.
    std::optional<std::size_t> mapAt(double east_m, double north_m) const;
    /// Around all maps.
    SceneBox box(double exaggeration) const;
    /// The smallest side of a pixel in metres.
    double pixelMetres() const;

private:
    bool isCovered(const ScenePoint& place, std::size_t index) const;
    double heightOf(const SceneMap& map, double east_m, double north_m) const;

    std::vector<SceneMap> maps_;
};

/// The frame that takes the grid of `map` into the scene of `scene`: through their common map
/// coordinates, on the turn of longitude that brings the two together.
SceneFrame frameWithin(const Georeference& scene, const Georeference& map);

} // namespace marsview
