// Where drawn positions lie in the scene and on the screen.
#pragma once

#include "core/annotations/drawn_vertex.h"
#include "core/measure/measured_terrain.h"
#include "ui/drawing/drawing_scene.h"

#include <QPointF>

#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// A stretch of a line as it lies on the terrain.
struct DrapedRun {
    std::vector<ScenePoint> points;
    std::vector<double> distances_m; // of the points from the line's beginning
};

/// On the topmost map of a scene, which outlives it. GUI thread; reads no samples from disk.
class DrapedGeometry {
public:
    explicit DrapedGeometry(const DrawingScene& scene)
        : scene_(&scene)
    {}

    /// Continues on another scene.
    void setScene(const DrawingScene& scene) { scene_ = &scene; }
    /// Follows the scene. Until it is called, positions are those of the map before.
    void update();
    /// Whether there is no map.
    bool isEmpty() const noexcept { return geometry_ == nullptr; }
    /// Of update(); the scene may show another one by now.
    const std::shared_ptr<const Map>& map() const noexcept { return map_; }
    /// Only with a map.
    const Ground& ground() const { return geometry_->ground(); }

    /// Empty if the vertex is on a body and the map is not, or the other way around.
    std::optional<GroundPosition> positionOf(const DrawnVertex& vertex) const;
    /// Empty outside the terrain.
    std::optional<ScenePoint> scenePoint(GroundPosition position) const;
    std::optional<ScenePoint> scenePoint(const DrawnVertex& vertex) const;
    /// As a DotIndex has it.
    std::optional<ScenePoint> dotPoint(const DrawnVertex& vertex) const;
    template <typename Where>
    std::optional<QPointF> screenPoint(const Where& where) const
    {
        const auto point = scenePoint(where);
        return point ? scene_->positionOf(*point) : std::nullopt;
    }
    /// Split until its parts are short on the screen; a run for each stretch that has terrain.
    std::vector<DrapedRun> draped(const GroundLine& line) const;
    /// Whether terrain in front of a place of the scene hides it.
    bool isHidden(const ScenePoint& place) const { return scene_->isHidden(place); }

private:
    const DrawingScene* scene_;
    std::shared_ptr<const Map> map_;
    std::unique_ptr<MeasuredTerrain> geometry_;
};

} // namespace marsview
