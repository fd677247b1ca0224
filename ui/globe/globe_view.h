// The globe: layers on their body, with a camera from space to the ground.
#pragma once

#include "core/terrain/ray_cast.h"
#include "ui/canvas/gestures.h"
#include "ui/canvas/grab_key.h"
#include "ui/canvas/map_cursor.h"
#include "ui/canvas/place_reader.h"
#include "ui/canvas/place_tool.h"
#include "ui/canvas/steered_view.h"
#include "ui/canvas/terrain_canvas.h"
#include "ui/canvas/tool.h"
#include "ui/globe/globe_camera.h"
#include "ui/globe/globe_ground.h"
#include "ui/globe/globe_layers.h"
#include "ui/globe/globe_meshes.h"
#include "ui/globe/globe_touch.h"
#include "ui/widgets/still_click.h"

#include <QOpenGLWidget>
#include <QPointF>
#include <QTimer>

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <vector>

class QLabel;

namespace marsview {

/// Joins the layers, the camera, the canvas that draws them, and the tools. Placing a layer takes
/// place on a worker thread: until then the view says so. GUI thread.
class GlobeView final : public QOpenGLWidget, public SteeredView, private CanvasScene {
    Q_OBJECT

public:
    explicit GlobeView(QWidget* parent = nullptr);
    ~GlobeView() override;

    /// The layers to show, top first, all of one body; none for an empty view. They lie on the
    /// ellipsoid of the lowest one. The camera stays if the layers before were of the same body.
    void setLayers(const std::vector<ShownLayer>& top_first);
    /// Those that have been placed, and their terrain.
    const std::vector<ShownLayer>& layers() const noexcept { return layers_.shown(); }
    const BodyScene& scene() const noexcept { return ground_.scene; }
    /// The topmost one; null until a layer is placed.
    const BodyTerrain* terrain() const noexcept
    {
        return ground_.isEmpty() ? nullptr : &ground_.scene.maps().front();
    }
    /// Those that cannot be placed, of those that were tried.
    std::vector<UnplacedLayer> unplacedLayers() const { return layers_.unplaced(); }
    /// Keeps the camera over its ground.
    void setExaggeration(double exaggeration);
    double exaggeration() const noexcept { return ground_.style.exaggeration; }
    void setLook(const TerrainLook& look);
    const TerrainLook& look() const noexcept { return ground_.style.look; }
    void setAntialiasing(bool is_wanted) { canvas_.setAntialiasing(is_wanted); }
    void setFrameTarget(std::chrono::milliseconds target) { canvas_.setFrameTarget(target); }
    /// What a drag with the left button does. A drag that is under way ends.
    void setTool(Tool tool);
    /// Hears of clicks, drags and keys while `tool` is chosen. Null for none; otherwise it outlives
    /// the view or is taken back before.
    void setPlaceTool(Tool tool, PlaceTool* place_tool) { place_tools_[tool] = place_tool; }
    /// Lines on the terrain in the body-fixed frame, drawn over every picture.
    void setLines(std::vector<DrapedLine> lines, LineSet set)
    {
        canvas_.setLines(std::move(lines), set);
    }
    void setDots(DotSet dots, LineSet set) { canvas_.setDots(std::move(dots), set); }
    /// What moves the stylus' proxy.
    void setContactModel(ContactModelKind model) { touch_.setModel(model); }
    /// The stylus of the mouse, in the body-fixed frame; nothing while it is lifted or another tool
    /// is chosen.
    const std::optional<StylusPose>& stylus() const noexcept { return touch_.pose(); }
    /// The mouse can press into the terrain.
    bool isTouchReady() const noexcept { return touch_.isReady(); }
    /// What is touched, by the mouse and by a device.
    GlobeMeshes& meshes() noexcept { return meshes_; }

    /// Where a haptic device has its stylus, in the body-fixed frame; nothing for none.
    void showDevice(const std::optional<StylusPose>& pose);
    /// The stylus drawn: the device's, unless the mouse presses with the Touch tool.
    const std::optional<StylusPose>& shownStylus() const noexcept;
    /// Whether the chosen tool places points: the button of a device's stylus is for it.
    bool isPlacing() const { return placeTool() != nullptr; }
    /// That button, with the stylus at a place of the body-fixed frame.
    void pressStylus(const ScenePoint& place);
    void releaseStylus();

    const BodyCamera& camera() const noexcept { return camera_.camera(); }
    const BodyCamera& cameraGoal() const noexcept { return camera_.goal(); }
    bool isMoving() const noexcept override { return camera_.isMoving(); }
    /// Within the limits; before a layer is placed, when it is.
    void setCamera(const BodyCamera& camera);
    /// At once, or when a layer is placed.
    void setHomeCamera();
    Viewport viewport() const;
    BodyLimits limits() const { return ground_.limits(); }

    void step(NavigationStep step) { camera_.step(step); }
    void steer(const CapRates& rates, double seconds) override { camera_.steer(rates, seconds); }
    void goHome() override { camera_.goHome(); }
    void turnNorthUp() { camera_.turnNorthUp(); }
    /// Flies along a great circle; `distance_m` of 0 keeps the distance.
    void flyTo(const GeographicPoint& place, double distance_m)
    {
        camera_.flyTo(place, distance_m);
    }
    void flyTo(const BodyCamera& camera);
    /// Flies there, and much nearer.
    void flyNearer(const GeographicPoint& place) { camera_.flyNearer(place); }
    /// Flies to where all of a layer is in sight, or does so when it is placed. False if the layer
    /// is not among those to show.
    bool flyToLayer(const std::shared_ptr<const Map>& map);
    /// The same, unless some of the layer is in the picture.
    bool revealLayer(const std::shared_ptr<const Map>& map);
    /// Looks at a place at once, from the same distance and side, or with another azimuth.
    void lookAt(const GeographicPoint& place, std::optional<Angle> azimuth = {})
    {
        camera_.lookAt(place, azimuth);
    }

    /// The terrain under a position of the widget: the layer, and where it is on its grid.
    std::optional<BodyScenePoint> groundAt(QPointF position) const;
    std::optional<BodyHit> hitAt(QPointF position) const;
    /// The same; where a layer has no data, the place there, with a height of NaN.
    std::optional<BodyScenePoint> placeAt(QPointF position) const;
    /// The terrain straight below or above a place of the body-fixed frame.
    std::optional<BodyScenePoint> groundBelow(const ScenePoint& place) const;
    /// The elevations of a layer in the picture; empty if the picture shows none of it.
    std::optional<HeightRange> rangeInPicture(const std::shared_ptr<const Map>& map) const;
    /// Whether nothing but terrain before it can hide a place.
    bool isInPicture(const ScenePoint& place) const;
    /// Under the stylus of a device, unless the pointer has just moved; otherwise under the
    /// pointer; at the middle while the pointer is elsewhere and the view has the focus. Its height
    /// is NaN where a layer has no data.
    std::optional<BodyScenePoint> reading() const;
    /// What reading() is the place of.
    ReadingSource readingSource() const;
    /// The reading is that of the middle, which the keyboard moves.
    bool isCrosshairShown() const;
    /// The pointer goes onto an overlay.
    void forgetPointer();
    /// Meters on the terrain in one point of the screen.
    double metersPerPoint(const BodyHit& hit) const;
    /// Meters along the ellipsoid in one point of the screen, across the view, for the terrain in
    /// the middle of it; without terrain there, for the camera's target. 0 before a layer is
    /// placed.
    double metersPerPointInMiddle() const;

    /// There is a graphics context.
    bool isReady() const noexcept { return canvas_.isReady(); }
    /// The exaggeration and look of now.
    const DrawStyle& style() const noexcept override { return ground_.style; }
    /// A part of the picture of any size that `camera` has, into `picture`, RGB888 of that size.
    /// False, and nothing drawn, while pieces of it are missing: they are on their way. With
    /// terrain only.
    Result<bool> drawPart(const BodyCamera& camera,
                          const DrawStyle& style,
                          const QRect& part,
                          const PartOptions& options,
                          QImage& picture);
    /// Pixels a side that the graphics driver draws; 0 without a graphics context.
    int pictureSideMax() { return canvas_.pictureSideMax(); }

    /// True when the picture shows all there is, as well as can be, and nothing moves.
    bool isPictureComplete() const
    {
        return canvas_.isComplete() && !layers_.isPlacing() && !isMoving();
    }

Q_SIGNALS:
    void readingChanged(const std::optional<BodyScenePoint>& ground);
    /// Camera or size of the picture.
    void sightChanged();
    /// The layer, its look or the exaggeration.
    void sceneChanged();
    void crosshairChanged(bool is_shown);
    /// shownStylus() may have changed.
    void stylusMoved();
    /// The grab key was pressed or released for a device.
    void grabbingChanged(bool is_grabbing);
    void toolChanged();
    /// Why the terrain cannot be touched.
    void touchFailed(const QString& reason);
    /// Why the edges of a layer are not blended.
    void blendingFailed(const QString& reason);
    /// A gesture of the mouse moved the camera or the stylus.
    void gestureMade(MapAction action);
    /// The context menu of what lies at a position in widget coordinates is asked for.
    void menuRequested(QPointF position);
    /// A position was clicked with a tool that places no points.
    void clicked(QPointF position);
    void detailChanged(double pixels);
    void loadingChanged(bool is_loading);
    void problemChanged(const QString& problem);
    /// A layer is placed, or others or none are shown.
    void placed();
    /// unplacedLayers() may have changed.
    void unplacedChanged();
    void pictureCompleted();
    /// No suitable graphics context, or no layer that can be placed on its body.
    void failed(const QString& reason);

protected:
    void initializeGL() override;
    void paintGL() override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;

private:
    std::vector<TerrainLayer> terrainLayers() const override;
    CanvasCamera canvasCamera() const override;
    bool isTouching() const noexcept override;
    std::optional<CursorPicture> canvasCursor() const override;
    std::optional<ScenePoint>
    groundUnderCursor(const CursorPicture& cursor, double right_m, double ahead_m) const override;
    void connectParts();
    void showLayers(bool is_other_body);
    void finishPlacing();
    bool flyWhenPlaced(const std::shared_ptr<const Map>& map);
    bool isAnyInPicture(const BodyTerrain& terrain) const;
    void flyToAwaited();
    void releaseGraphics() { canvas_.release(); }
    void report();
    PixelPoint pixelAt(QPointF position) const;
    PlaceTool* placeTool() const;
    void endDrag();
    void followTouch();
    void grab();
    void releaseGrab();
    bool moveByGrab(QPointF from, QPointF to);
    std::optional<RayHit> onTopmost(const ScenePoint& place) const;
    void moveStylus(const ScenePoint& place);
    void notePointer(QPointF position);
    bool isStylusRead() const { return device_ && !lead_timer_.isActive(); }
    void showCursor();

    GlobeLayers layers_;
    GlobeGround ground_;
    GlobeCamera camera_;
    std::optional<BodyCamera> first_camera_; // when a layer is placed
    std::weak_ptr<const Map> awaited_;       // to fly to when it is placed
    bool is_awaited_only_unseen_ = false;    // and none of it is in the picture then
    Tool tool_ = Tool::Pan;
    std::map<Tool, PlaceTool*> place_tools_;

    MapAction drag_ = MapAction::None;
    Qt::MouseButton drag_button_ = Qt::NoButton;
    bool may_be_click_ = false; // the drag has not left the place where it began
    StillClick still_click_;
    QPointF drag_position_;
    bool was_crosshair_shown_ = false;
    bool is_over_terrain_ = false; // the pointer
    std::optional<HeldPoint> held_;
    std::optional<QPointF> pointer_;

    GlobeMeshes meshes_;
    GlobeTouch touch_{meshes_};
    std::optional<StylusPose> device_;
    GrabKey grab_key_;
    std::optional<HeldPoint> grabbed_; // by the stylus of the mouse, in contact
    QTimer lead_timer_; // runs while the pointer is read in place of the device's stylus
    MapCursor cursor_ = MapCursor::Arrow;
    TerrainCanvas canvas_;
    QTimer sample_timer_;
    QLabel* wait_ = nullptr;
};

} // namespace marsview
