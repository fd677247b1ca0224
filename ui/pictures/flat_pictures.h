// Pictures of the flat map.
#pragma once

#include "ui/pictures/picture_scene.h"

namespace marsview {

class DrawnMarks;
class MapOverlays;
class TerrainView;

/// A child of the view. The overlays outlive it.
class FlatPictures final : public PictureScene {
    Q_OBJECT

public:
    FlatPictures(TerrainView& view, MapOverlays& overlays);

    /// Points and labels that belong to the lines on the map; they outlive this.
    void addMarks(const DrawnMarks& marks) { marks_.push_back(&marks); }

    bool isReady() const override;
    bool isComplete() const override;
    SceneCamera camera() const override;
    void setCamera(const SceneCamera& camera) override;
    bool isMoving() const override;
    const DrawStyle& style() const override;
    Viewport viewport() const override;
    double devicePixelRatio() const override;
    int sideMax() override;
    Result<bool> drawPart(const SceneCamera& camera,
                          const DrawStyle& style,
                          const QRect& part,
                          const PartOptions& options,
                          QImage& picture) override;
    std::vector<PicturePart>
    partsFor(const SceneCamera& camera, const QSize& picture, const PictureParts& parts) override;
    std::optional<SceneCamera>
    cameraFor(const Session& session, const SavedView& view, double exaggeration) const override;
    const Map* topmost() const override;
    CameraPath pathThrough(const std::vector<SceneCamera>& cameras, FlightPace pace) const override;
    CameraPath pathAlong(const std::vector<ScenePoint>& line,
                         const LineFlight& flight) const override;
    SceneCamera cameraOn(const CameraPath& path, double share) const override;
    PictureFacts facts(const QSize& picture) const override;

private:
    CameraPath aboveGround(const CameraPath& path) const;

    TerrainView& view_;
    MapOverlays& overlays_;
    std::vector<const DrawnMarks*> marks_;
};

/// The camera of the flat map for a saved view: its body is that of the layers that `view` shows,
/// or its layer is on top.
std::optional<OrbitCamera> sceneCamera(const TerrainView& view,
                                       const Session& session,
                                       const SavedView& saved,
                                       double exaggeration);

} // namespace marsview
