// What the view shows: layers as one surface, with an exaggeration and a look.
#pragma once

#include "core/session/scene_surface.h"
#include "ui/canvas/shown_layer.h"
#include "ui/render/terrain_renderer.h"

#include <memory>
#include <vector>

namespace marsview {

/// Heights of the scene are exaggerated. For the GUI thread.
class ShownScene {
public:
    /// Top first; all in one CRS.
    void setLayers(const std::vector<ShownLayer>& top_first);
    const std::vector<ShownLayer>& layers() const noexcept { return layers_; }
    bool isEmpty() const noexcept { return layers_.empty(); }
    /// The topmost map and its color ramp; null if the scene is empty.
    const std::shared_ptr<const Map>& map() const noexcept;
    const ColorRamp* ramp() const noexcept;
    /// The terrain of all layers.
    const SceneSurface& ground() const noexcept { return ground_; }

    /// The height of the terrain in scene meters; NaN without terrain there.
    double groundHeight(double east_m, double north_m) const;
    /// The terrain straight above or below a place.
    std::optional<GroundPoint> groundBelow(const ScenePoint& place) const;
    std::optional<GroundPoint> cast(const Ray& ray) const;
    /// For a ray that meets no terrain: where it passes through a hole of a map, with a height of
    /// NaN. The hole counts as level, at the elevation of the topmost map that is nearest to 0.
    std::optional<GroundPoint> voidOn(const Ray& ray) const;
    /// Where a point of the terrain is in the scene; without a height, as of voidOn().
    ScenePoint placeOf(const GroundPoint& ground) const;
    /// The same for a place on the topmost map's grid. Not for an empty scene.
    ScenePoint placeOf(GridPoint grid, double height_m) const;
    /// A point of the terrain on the topmost map's grid, which lower maps may reach beyond.
    RayHit onTopmost(const GroundPoint& ground) const;
    SceneBox box() const { return ground_.box(style.exaggeration); }

    DrawStyle style;

private:
    double voidLevelM() const;
    double sceneHeight(double height_m) const;

    std::vector<ShownLayer> layers_;
    SceneSurface ground_;
};

} // namespace marsview
