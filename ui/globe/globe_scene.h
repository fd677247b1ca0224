// Drawn items on the globe.
#pragma once

#include "core/globe/body_camera.h"
#include "core/globe/body_view.h"
#include "ui/drawing/drawing_scene.h"

#include <memory>
#include <optional>

namespace marsview {

class GlobeView;
struct BodyScenePoint;

/// The globe outlives it.
class GlobeScene final : public DrawingScene {
public:
    explicit GlobeScene(GlobeView& globe, QObject* parent = nullptr);

    const QWidget& view() const override;
    std::shared_ptr<const Map> map() const override;
    CameraPose camera() const override;
    double exaggeration() const override;
    std::optional<ScenePoint> onTerrain(const MeasuredTerrain& terrain,
                                        GroundPosition position) const override;
    std::optional<QPointF> positionOf(const ScenePoint& place) const override;
    bool isHidden(const ScenePoint& place) const override;
    bool isBehindHorizon(const ScenePoint& place) const override;
    bool isOutOfSight(const std::optional<ScenePoint>& from,
                      const std::optional<ScenePoint>& to,
                      double length_m) const override;
    double dotExaggeration() const override { return 1.0; }
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
    /// The picture of now. Only with a map.
    const BodyView& bodyView() const;

private:
    struct Sight {
        BodyCamera of;
        BodyView view;
    };

    std::optional<ScenePoint> onTerrain(const GeographicPoint& place) const;
    std::optional<Place> placeOf(const std::optional<BodyScenePoint>& ground) const;
    void noteScene();

    GlobeView& globe_;
    double exaggeration_ = 1.0;                     // as of the last noteScene()
    HeightRange range_{};                           // of all maps
    mutable std::optional<Sight> sight_;            // of the camera of now
    mutable std::shared_ptr<const ScenePlan> plan_; // the latest
};

} // namespace marsview
