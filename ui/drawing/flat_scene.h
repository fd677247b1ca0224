// Drawn items on the flat map.
#pragma once

#include "ui/canvas/terrain_view.h"
#include "ui/drawing/drawing_scene.h"

namespace marsview {

/// The view outlives it.
class FlatScene final : public DrawingScene {
public:
    explicit FlatScene(TerrainView& view);

    const QWidget& view() const override { return view_; }
    std::shared_ptr<const Map> map() const override { return view_.map(); }
    CameraPose camera() const override { return view_.camera(); }
    double exaggeration() const override { return view_.exaggeration(); }
    std::optional<ScenePoint> onTerrain(const MeasuredTerrain& terrain,
                                        GroundPosition position) const override;
    std::optional<QPointF> positionOf(const ScenePoint& place) const override
    {
        return view_.positionOfPlace(place);
    }
    bool isHidden(const ScenePoint& place) const override;
    bool isBehindHorizon(const ScenePoint& /*place*/) const override { return false; }
    bool isOutOfSight(const std::optional<ScenePoint>& from,
                      const std::optional<ScenePoint>& to,
                      double length_m) const override;
    double dotExaggeration() const override { return view_.exaggeration(); }
    DotSight dotSight(const QRectF& area) const override;
    std::optional<Place> placeAt(QPointF position) const override;
    std::optional<Place> placeRead() const override;
    bool isReadByStylus() const override;
    void setPlaceTool(Tool tool, PlaceTool* place_tool) override;
    void setLines(std::vector<DrapedLine> lines, LineSet set) override;
    void setDots(DotSet dots, LineSet set) override;
    void flyToAll(const std::vector<ScenePoint>& places) override;
    std::shared_ptr<const ScenePlan> plan() const override;
    std::optional<ScenePoint> onTerrain(const PlanePoint& point) const override;
    std::function<double(const PlaneBox&)> planResolution() const override;
    void flyToBox(const PlaneBox& box) override;

private:
    std::optional<Place> placeOf(const RayHit& hit, const std::optional<QPointF>& position) const;

    TerrainView& view_;
    mutable std::shared_ptr<const ScenePlan> plan_; // the latest
};

} // namespace marsview
