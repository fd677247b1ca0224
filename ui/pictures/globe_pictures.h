// Pictures of the globe.
#pragma once

#include "ui/pictures/picture_scene.h"

namespace marsview {

class GlobeOverlays;
class GlobeView;

/// A child of the globe. The overlays outlive it.
class GlobePictures final : public PictureScene {
    Q_OBJECT

public:
    GlobePictures(GlobeView& globe, GlobeOverlays& overlays);

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

    GlobeView& globe_;
    GlobeOverlays& overlays_;
};

/// The camera of a globe for a saved view; empty for a view in the map coordinates of a map.
std::optional<BodyCamera> bodyCamera(const ViewCamera& camera, double exaggeration);

} // namespace marsview
