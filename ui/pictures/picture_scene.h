// A scene that pictures are drawn of.
#pragma once

#include "core/flight/camera_path.h"
#include "core/globe/body_camera.h"
#include "core/session/saved_view.h"
#include "core/session/session.h"
#include "ui/canvas/part_drawing.h"
#include "ui/overlay/legend.h"
#include "ui/widgets/picture_part.h"

#include <QImage>
#include <QObject>
#include <QRect>
#include <QSize>

#include <memory>
#include <optional>
#include <vector>

class QWidget;

namespace marsview {

/// What a picture shows, for people.
struct PictureFacts {
    std::vector<std::shared_ptr<const Map>> maps; // top first; not empty
    GridPoint middle{};                           // on the grid of the first one
    double pixel_m = 1.0;                         // there, across the view
    Angle heading{};         // clockwise from true north, or from the map's on an unknown body
    bool is_on_body = false; // of maps in any CRS
    LegendContent legend{};
};

/// The flat map or the globe, with its overlays. GUI thread.
class PictureScene : public QObject {
    Q_OBJECT

public:
    using QObject::QObject;

    /// There are a graphics context and terrain.
    virtual bool isReady() const = 0;
    /// The picture in the window shows all there is, as well as can be, and nothing moves.
    virtual bool isComplete() const = 0;
    virtual SceneCamera camera() const = 0;
    /// One of this scene, within its limits.
    virtual void setCamera(const SceneCamera& camera) = 0;
    virtual bool isMoving() const = 0;
    virtual const DrawStyle& style() const = 0;
    /// Of the picture in the window.
    virtual Viewport viewport() const = 0;
    virtual double devicePixelRatio() const = 0;
    /// The longest side of a picture in pixels; 0 without a graphics context.
    virtual int sideMax() = 0;
    /// Draws a part of the picture of any size that `camera`, one of this scene, has, into
    /// `picture`, RGB888 of that size. False, and nothing drawn, while pieces of it are missing:
    /// they are on their way.
    virtual Result<bool> drawPart(const SceneCamera& camera,
                                  const DrawStyle& style,
                                  const QRect& part,
                                  const PartOptions& options,
                                  QImage& picture) = 0;
    /// The overlays for a picture of any size that `camera` takes of the same layers. Their size
    /// grows with the height of the picture: they are as large as in the window if it is as high.
    /// They keep their distances from the corners.
    virtual std::vector<PicturePart>
    partsFor(const SceneCamera& camera, const QSize& picture, const PictureParts& parts) = 0;
    /// The camera for a saved view, if it can be seen with the layers that are shown.
    virtual std::optional<SceneCamera>
    cameraFor(const Session& session, const SavedView& view, double exaggeration) const = 0;

    /// The topmost layer; null without terrain.
    virtual const Map* topmost() const = 0;
    /// The motion through cameras of this scene, of which there is at least one, clear of the
    /// terrain.
    virtual CameraPath pathThrough(const std::vector<SceneCamera>& cameras,
                                   FlightPace pace) const = 0;
    /// The motion along a line of at least two different points of this scene, clear of the
    /// terrain.
    virtual CameraPath pathAlong(const std::vector<ScenePoint>& line,
                                 const LineFlight& flight) const = 0;
    /// Where such a path is at a share of its time, raised if tiles that have come since it was
    /// planned are higher.
    virtual SceneCamera cameraOn(const CameraPath& path, double share) const = 0;
    /// Of a picture so large that the window's camera has. With terrain only.
    virtual PictureFacts facts(const QSize& picture) const = 0;

Q_SIGNALS:
    void layersChanged();
    void lookChanged();
    void pictureCompleted();
    /// Camera or size of the picture in the window.
    void sightChanged();

protected:
    // Overlays in the corners of `view`, those that it shows.
    static std::vector<PicturePart>
    platesFor(const QWidget& view, const std::vector<QWidget*>& plates, const QSize& picture);
    static std::vector<QRect> placesOf(const std::vector<PicturePart>& parts);
    static void append(std::vector<PicturePart>& parts, std::vector<PicturePart> more);
};

} // namespace marsview
