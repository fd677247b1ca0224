// The globe: layers on their body, with a camera from space to the ground.
#pragma once

#include "core/base/job_monitor.h"
#include "core/globe/body_motion.h"
#include "core/globe/body_navigation.h"
#include "core/session/body_terrain.h"
#include "core/terrain/ray_cast.h"
#include "ui/canvas/camera_controller.h"
#include "ui/canvas/gestures.h"
#include "ui/canvas/grab_key.h"
#include "ui/canvas/line_painter.h"
#include "ui/canvas/line_sets.h"
#include "ui/canvas/map_cursor.h"
#include "ui/canvas/part_drawing.h"
#include "ui/canvas/place_reader.h"
#include "ui/canvas/place_tool.h"
#include "ui/canvas/shown_layer.h"
#include "ui/canvas/steered_view.h"
#include "ui/canvas/tool.h"
#include "ui/controllers/detached_jobs.h"
#include "ui/globe/globe_meshes.h"
#include "ui/globe/globe_motion.h"
#include "ui/globe/globe_touch.h"
#include "ui/render/cursor_solids.h"
#include "ui/render/governed_picture.h"
#include "ui/render/terrain_renderer.h"

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

/// Shows layers where they lie on their body. Placing a layer takes place on a worker thread: until
/// then the view says so. GUI thread.
class GlobeView final : public QOpenGLWidget, public SteeredView {
    Q_OBJECT

public:
    explicit GlobeView(QWidget* parent = nullptr);
    ~GlobeView() override;

    /// The layers to show, top first, all of one body; none for an empty view. They lie on the
    /// ellipsoid of the lowest one. The camera stays if the layers before were of the same body.
    void setLayers(const std::vector<ShownLayer>& top_first);
    /// Those that have been placed, and their terrain.
    const std::vector<ShownLayer>& layers() const noexcept { return layers_; }
    const BodyScene& scene() const noexcept { return scene_; }
    /// The topmost one; null until a layer is placed.
    const BodyTerrain* terrain() const noexcept
    {
        return scene_.isEmpty() ? nullptr : &scene_.maps().front();
    }
    /// Keeps the camera over its ground.
    void setExaggeration(double exaggeration);
    double exaggeration() const noexcept { return style_.exaggeration; }
    void setLook(const TerrainLook& look);
    const TerrainLook& look() const noexcept { return style_.look; }
    void setAntialiasing(bool is_wanted);
    void setFrameTarget(std::chrono::milliseconds target);
    /// What a drag with the left button does. A drag that is under way ends.
    void setTool(Tool tool);
    /// Hears of clicks, drags and keys while `tool` is chosen. Null for none; otherwise it outlives
    /// the view or is taken back before.
    void setPlaceTool(Tool tool, PlaceTool* place_tool) { place_tools_[tool] = place_tool; }
    /// Lines on the terrain in the body-fixed frame, drawn over every picture.
    void setLines(std::vector<DrapedLine> lines, LineSet set);
    void setDots(DotSet dots, LineSet set);
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

    const BodyCamera& camera() const noexcept { return motion_.camera(); }
    const BodyCamera& cameraGoal() const noexcept { return motion_.goal(); }
    bool isMoving() const noexcept override { return motion_.isMoving(); }
    /// Within the limits; before a layer is placed, when it is.
    void setCamera(const BodyCamera& camera);
    /// At once, or when a layer is placed.
    void setHomeCamera();
    Viewport viewport() const;
    BodyLimits limits() const;

    void step(NavigationStep step);
    void steer(const CapRates& rates, double seconds) override;
    void goHome() override;
    void turnNorthUp();
    /// Flies along a great circle; `distance_m` of 0 keeps the distance.
    void flyTo(const GeographicPoint& place, double distance_m);
    void flyTo(const BodyCamera& camera);
    /// Flies there, and much nearer.
    void flyNearer(const GeographicPoint& place);
    /// Flies to where all of a layer is in sight, or does so when it is placed. False if the layer
    /// is not among those to show.
    bool flyToLayer(const std::shared_ptr<const Map>& map);
    /// Looks at a place at once, from the same side and distance.
    void lookAt(const GeographicPoint& place);

    /// The terrain under a position of the widget: the layer, and where it is on its grid.
    std::optional<BodyScenePoint> groundAt(QPointF position) const;
    std::optional<BodyHit> hitAt(QPointF position) const;
    /// The terrain straight below or above a place of the body-fixed frame.
    std::optional<BodyScenePoint> groundBelow(const ScenePoint& place) const;
    /// The elevations of a layer in the picture; empty if the picture shows none of it.
    std::optional<HeightRange> rangeInPicture(const std::shared_ptr<const Map>& map) const;
    /// Whether nothing but terrain before it can hide a place.
    bool isInPicture(const ScenePoint& place) const;
    /// Under the stylus of a device, unless the pointer has just moved; otherwise under the
    /// pointer; at the middle while the pointer is elsewhere and the view has the focus.
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
    bool isReady() const noexcept { return renderer_ != nullptr; }
    /// The exaggeration and look of now.
    const DrawStyle& style() const noexcept { return style_; }
    /// A part of the picture of any size that `camera` has, into `picture`, RGB888 of that size.
    /// False, and nothing drawn, while pieces of it are missing: they are on their way. With
    /// terrain only.
    Result<bool> drawPart(const BodyCamera& camera,
                          const DrawStyle& style,
                          const QRect& part,
                          PictureLines lines,
                          QImage& picture);
    /// Pixels a side that the graphics driver draws; 0 without a graphics context.
    int pictureSideMax();

    /// True when the picture shows all there is, as well as can be, and nothing moves.
    bool isPictureComplete() const { return is_complete_ && !placing_ && !isMoving(); }

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
    /// A gesture of the mouse moved the camera or the stylus.
    void gestureMade(MapAction action);
    /// The context menu of what lies at a position in widget coordinates is asked for.
    void menuRequested(QPointF position);
    void detailChanged(double pixels);
    void loadingChanged(bool is_loading);
    void problemChanged(const QString& problem);
    /// A layer is placed, or others or none are shown.
    void placed();
    void pictureCompleted();
    /// No suitable graphics context, or a layer that has no place on its body.
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
    // A map on its body, or why it has no place there.
    struct Placed {
        std::shared_ptr<const Map> map;
        std::shared_ptr<const BodyGrid> grid;
        QString problem;
    };

    std::optional<Ellipsoid> sceneEllipsoid() const;
    const Placed* placedOf(const ShownLayer& layer) const;
    void placeNext();
    void showPlaced();
    void showMissing();
    void sendLayers();
    void releaseGraphics();
    void redraw();
    void refine();
    void report();
    BodyCamera bounded(const BodyCamera& camera) const;
    BodyCamera onGround(const BodyCamera& camera) const;
    HeldPoint heldAtPosition(QPointF position) const;
    PixelPoint pixelAt(QPointF position) const;
    BodyLimits limitsOf(const BodyTerrain& map) const;
    BodyCamera homeView() const;
    BodyCamera viewOf(const BodyTerrain& map) const;
    void flyToAwaited();
    void fly(const BodyCamera& goal, std::chrono::milliseconds duration);
    void zoom(double factor, QPointF position, std::chrono::milliseconds duration);
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
    void paintOver(TerrainPicture terrain);
    void paintLines(TerrainPicture terrain);
    void paintCursor();
    std::vector<ScenePoint> shadowAt(const StylusPose& pose, double radius_m) const;

    std::vector<ShownLayer> wanted_; // top first
    std::vector<Placed> placed_;
    std::vector<ShownLayer> layers_; // of those the ones that are shown
    BodyScene scene_;                // of these
    std::shared_ptr<JobMonitor> placing_;
    DetachedJobs jobs_;
    DrawStyle style_;
    std::optional<BodyCamera> first_camera_; // when a layer is placed
    std::weak_ptr<const Map> awaited_;       // to fly to when it is placed
    GlobeMotion motion_;
    Tool tool_ = Tool::Pan;
    std::map<Tool, PlaceTool*> place_tools_;
    LineSets lines_;

    MapAction drag_ = MapAction::None;
    Qt::MouseButton drag_button_ = Qt::NoButton;
    bool may_be_click_ = false; // the drag has not left the place where it began
    QPointF drag_position_;
    bool was_crosshair_shown_ = false;
    bool is_over_terrain_ = false; // the pointer
    std::optional<HeldPoint> held_;
    std::optional<QPointF> pointer_;
    CapRates cap_;           // that moved the camera last
    double zoom_left_ = 1.0; // the whole factor of the zoom in progress
    bool is_zooming_ = false;

    GlobeMeshes meshes_;
    GlobeTouch touch_{meshes_};
    std::optional<StylusPose> device_;
    GrabKey grab_key_;
    std::optional<HeldPoint> grabbed_; // by the stylus of the mouse, in contact
    QTimer lead_timer_; // runs while the pointer is read in place of the device's stylus
    MapCursor cursor_ = MapCursor::Arrow;
    std::unique_ptr<TerrainRenderer> renderer_;
    std::unique_ptr<GovernedPicture> picture_;
    std::unique_ptr<LinePainter> line_painter_;
    std::unique_ptr<CursorSolids> cursor_solids_;
    std::chrono::milliseconds frame_target_{33};
    bool has_antialiasing_ = true;
    bool are_layers_sent_ = true;
    PictureStage stage_ = PictureStage::Moving;
    bool is_current_ = false; // the picture that was kept is of now
    bool is_complete_ = false;
    bool is_loading_ = false;
    QString problem_;
    QTimer still_timer_;
    QTimer sample_timer_;
    QLabel* note_ = nullptr;
    QLabel* wait_ = nullptr;
};

} // namespace marsview
