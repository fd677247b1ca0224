// The view of the map, with the styluses of the mouse and the device.
#pragma once

#include "core/session/scene_surface.h"
#include "core/view/cap_steering.h"
#include "core/view/navigation.h"
#include "haptics/interaction/stylus.h"
#include "ui/canvas/map_cursor.h"
#include "ui/canvas/navigator.h"
#include "ui/canvas/place_tool.h"
#include "ui/canvas/shown_layer.h"
#include "ui/render/cursor_renderer.h"
#include "ui/render/governed_picture.h"
#include "ui/render/line_renderer.h"
#include "ui/render/terrain_renderer.h"

#include <QOpenGLWidget>
#include <QTimer>

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

class QLabel;

namespace marsview {

/// A motion of the camera by one step: what keys and menu entries ask for.
enum class NavigationStep {
    PanLeft,
    PanRight,
    PanAway,
    PanNearer,
    ZoomIn,
    ZoomOut,
    TurnLeft,
    TurnRight,
    TiltUp,
    TiltDown,
};

/// What the place that is read lies under.
enum class ReadingSource { Pointer, Stylus, Crosshair };

/// A property of children of the view that hide the terrain, though the mouse goes through them.
inline constexpr const char* kHidesTerrain = "hidesTerrain";

/// Hosts the renderer and turns input into motions of the camera and of the stylus. Draws only when
/// something changed: the terrain when it or the camera did, otherwise only the cursor over it.
class TerrainView final : public QOpenGLWidget {
    Q_OBJECT

public:
    explicit TerrainView(QWidget* parent = nullptr);
    ~TerrainView() override;

    /// Replaces the layers shown, top first; none for an empty view. All have one CRS. The camera
    /// stays if one of the maps in sight, or the map of a preview in sight, is among the new
    /// layers. A map that was shown before gets its last view, a new one its opening view.
    /// mapShown() follows. Without an exaggeration the view chooses one: the current one if the
    /// camera stays, the map's last one, or the one that suits a new map.
    void setLayers(const std::vector<ShownLayer>& top_first,
                   std::optional<double> exaggeration = std::nullopt);
    /// As they were set, top first.
    const std::vector<ShownLayer>& shownLayers() const noexcept { return shown_; }
    /// `map` is about to replace `preview` and takes over its view. Call before setLayers().
    void replacePreview(const std::shared_ptr<const Map>& preview,
                        const std::shared_ptr<const Map>& map);
    /// The topmost map shown; none where there is none.
    const std::shared_ptr<const Map>& map() const noexcept { return map_; }
    /// Its color ramp; null without a map.
    const ColorRamp* ramp() const noexcept { return ramp_; }
    /// Everything that is shown.
    const SceneSurface& ground() const noexcept { return ground_; }

    /// The text in the middle of an empty view; if empty, how to open a map.
    void setHint(const QString& hint);
    void setLook(const TerrainLook& look);
    const TerrainLook& look() const noexcept { return style_.look; }
    void setAntialiasing(bool is_wanted);
    /// The time that a frame may take while something moves.
    void setFrameTarget(std::chrono::milliseconds target);

    const OrbitCamera& camera() const noexcept { return navigator_.camera(); }
    /// Where the camera will be when it has come to rest.
    const OrbitCamera& cameraGoal() const noexcept { return navigator_.goal(); }
    /// Of the picture, in pixels of the frame buffer.
    Viewport viewport() const;
    /// Jumps, within the limits.
    void setCamera(const OrbitCamera& camera);
    bool isMoving() const noexcept { return navigator_.isMoving(); }

    double exaggeration() const noexcept { return style_.exaggeration; }
    /// Keeps the piece of ground in the middle of the picture there.
    void setExaggeration(double exaggeration);

    /// What moves the stylus' proxy.
    void setContactModel(ContactModelKind model);
    ContactModelKind contactModel() const noexcept { return stylus_.model(); }

    /// What a drag with the left button does; Pan to begin with. A drag that is under way ends.
    void setTool(Tool tool);
    Tool tool() const noexcept { return tool_; }
    /// Hears of clicks, drags and keys while Tool::Measure is chosen. Null for none; otherwise it
    /// outlives the view or is taken back before.
    void setPlaceTool(PlaceTool* tool) { place_tool_ = tool; }
    /// Lines on the terrain, drawn over every picture.
    void setLines(std::vector<DrapedLine> lines);

    void step(NavigationStep step);
    /// Moves as a cap is pushed, for the time since it was asked last: once a frame while the cap
    /// is pushed, and once at rest to end with. Draws nothing where the camera stays where it is.
    void steer(const CapRates& rates, double seconds);
    void goHome();
    void turnNorthUp();
    /// Flies to a place of the topmost layer; `distance_m` of 0 keeps the distance.
    void flyTo(GridPoint grid, double distance_m);
    /// The same at the same distance, with the focus, for a place that was typed: it is what is
    /// read until the pointer or the camera moves.
    void goTo(GridPoint grid);
    /// The same to a place of the scene, from the same side and distance.
    void flyToPlace(const ScenePoint& place);
    /// Flies to what surfaceAt() found, and much nearer to it.
    void flyNearer(const RayHit& hit);
    /// Flies until the camera is this one, within the limits.
    void flyTo(const OrbitCamera& camera);
    /// Looks at a place of the scene at once, from the same side and distance.
    void lookAt(const ScenePoint& place);

    /// The ground behind a position in widget coordinates, at full resolution: where it is on the
    /// topmost map's grid, which lower maps may reach beyond.
    std::optional<RayHit> surfaceAt(QPointF position) const;
    /// The same with the map that it is on, and the place on that map's own grid.
    std::optional<GroundPoint> groundUnder(QPointF position) const;
    /// The place that is read: under the stylus of a haptic device, unless the pointer or a key has
    /// just moved; otherwise under the pointer; or at the crosshair in the middle of the picture,
    /// while the view has the focus and the pointer is not over it or a key moved the camera last.
    /// Nothing where no surface is there.
    std::optional<RayHit> reading() const;
    /// What reading() is the place of.
    ReadingSource readingSource() const;
    bool isCrosshairShown() const;
    /// Meters on the terrain in one point of the screen at a place that surfaceAt() found.
    double metersPerPoint(const RayHit& hit) const;
    /// Keeps the crosshair while another widget that shows the reading has the focus.
    void setReadElsewhere(bool is_read);
    /// False for pictures of the window: no crosshair in them.
    void setCrosshairAllowed(bool is_allowed);
    /// A position of the topmost map's surface in widget coordinates.
    std::optional<QPointF> positionOf(GridPoint grid) const;
    /// A place of the scene in widget coordinates; nothing where it is behind the eye.
    std::optional<QPointF> positionOfPlace(const ScenePoint& place) const;
    /// Whether nothing but ground before it can hide a place of the scene.
    bool isInPicture(const ScenePoint& place) const;

    /// There is a graphics context.
    bool isReady() const noexcept { return renderer_ != nullptr; }
    /// True when the picture shows all there is, as well as can be, and nothing moves.
    bool isPictureComplete() const;
    /// See problemChanged().
    const QString& problem() const noexcept { return problem_; }
    const std::optional<StylusPose>& stylus() const noexcept { return stylus_.pose(); }
    /// Where a haptic device has its stylus; nothing for none.
    void showDevice(const std::optional<StylusPose>& pose);
    /// The stylus drawn: the device's, unless the mouse presses or grabs with the Touch tool. The
    /// mouse has a stylus with the Touch tool only.
    const std::optional<StylusPose>& shownStylus() const noexcept;
    /// The picture of the terrain alone, without cursor.
    QImage terrainPicture();
    /// The exaggeration and look of now.
    const DrawStyle& style() const noexcept { return style_; }
    /// A part of the picture of any size that `camera` has, into `picture`, RGB888 of that size.
    /// False, and nothing drawn, while pieces of it are missing: they are on their way.
    Result<bool>
    drawPart(const OrbitCamera& camera, const DrawStyle& style, const QRect& part, QImage& picture);
    /// Pixels a side that the graphics driver draws; 0 without a graphics context.
    int pictureSideMax();

Q_SIGNALS:
    /// There is a graphics context.
    void ready();
    /// No suitable graphics context is available.
    void unavailable(const QString& reason);
    void mapShown(const std::shared_ptr<const Map>& map);
    /// setLayers() or setLook() took effect.
    void layersChanged();
    void lookChanged();
    void pictureCompleted();
    /// reading() changed.
    void pointerMoved(const std::optional<RayHit>& hit);
    void exaggerationChanged(double exaggeration);
    /// Camera or size of the picture changed.
    void sightChanged();
    /// The screen-space error of the picture, in pixels.
    void detailChanged(double pixels);
    /// Whether pieces that the picture at rest lacks are on their way.
    void loadingChanged(bool is_loading);
    /// Why pieces of the picture cannot be read, or empty where all can.
    void problemChanged(const QString& problem);
    /// Something of shownStylus() changed.
    void stylusMoved();
    /// isCrosshairShown() changed.
    void crosshairChanged(bool is_shown);
    /// The grab key was pressed or released.
    void grabbingChanged(bool is_grabbing);
    void toolChanged(Tool tool);
    /// A gesture of the mouse moved the camera or the stylus, or asked for the menu.
    void gestureMade(MapAction action);
    /// The context menu of what lies at a position in widget coordinates is asked for.
    void menuRequested(QPointF position);

protected:
    void initializeGL() override;
    void paintGL() override;
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;
    void childEvent(QChildEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;
    void leaveEvent(QEvent* event) override;

private:
    // How a map was looked at.
    struct Sight {
        std::weak_ptr<const Map> map; // the topmost
        OrbitCamera camera;
        double exaggeration = 1.0;
    };

    void rememberSight();
    std::optional<Sight> sightToGoOnWith(const SceneSurface& before) const;
    void reportUnavailable(const QString& reason);
    void releaseGraphics();
    void paintTerrain();
    void paintLines();
    void paintCursor();
    PixelArea areaOf(const CursorPicture& cursor) const;
    void refineWhenStill();
    void finishStage();
    void report(const DrawReport& report);
    void redrawTerrain();
    void redrawWithNews();
    PictureStage lastStage() const;
    void goToOpeningView();
    PixelPoint pixelAt(QPointF position) const;
    double groundAt(double east_m, double north_m) const;
    NavigationLimits limits() const;
    OrbitCamera bounded(const OrbitCamera& camera) const;
    OrbitCamera onGround(const OrbitCamera& camera) const;
    OrbitCamera lookingAt(const ScenePoint& place, const OrbitCamera& camera) const;
    OrbitCamera beforeZoom(double factor) const;
    ScenePoint anchorAt(QPointF position, const OrbitCamera& camera) const;
    bool moveByGrab(QPointF from, QPointF to);
    void setGrabbing(bool is_grabbing);
    void moveStylus();
    bool isStylusRead() const;
    std::optional<GroundPoint> groundRead() const;
    void leadReading();
    RayHit onTopmost(const GroundPoint& ground) const;
    void setKeyboardUsed(bool is_used);
    void forgetPointer();
    bool isOverOverlay(QPointF position) const;
    void reportPointer();
    void readUnderPointer();
    PlaceTool* placeTool() const noexcept { return tool_ == Tool::Measure ? place_tool_ : nullptr; }
    void beginDrag(MapAction action);
    void dragTo(QPointF position);
    void endDrag();
    void releaseTouch();
    void refreshTouch();
    void showMapCursor();

    std::unique_ptr<TerrainRenderer> renderer_;
    std::unique_ptr<GovernedPicture> picture_;
    std::unique_ptr<CursorRenderer> cursor_;
    std::unique_ptr<LineRenderer> line_renderer_;
    std::vector<DrapedLine> lines_;
    Navigator navigator_;
    DrawStyle style_;
    std::chrono::milliseconds frame_target_{33};
    bool has_antialiasing_ = true;

    std::vector<ShownLayer> shown_;
    std::shared_ptr<const Map> map_;
    const ColorRamp* ramp_ = nullptr;
    SceneSurface ground_;
    std::vector<TerrainLayer> layers_;
    bool are_layers_sent_ = true;
    std::vector<Sight> sights_;       // of maps that are still alive
    bool is_at_opening_view_ = false; // the camera has not moved since

    PictureStage stage_ = PictureStage::Moving;
    bool is_terrain_current_ = false; // the picture that was kept is of now
    bool is_completion_reported_ = false;
    bool is_context_missing_ = false;
    bool is_loading_ = false;
    QString problem_;
    bool is_cursor_shown_ = true;
    QTimer pointer_timer_; // runs until what is under the pointer has been read
    QTimer lead_timer_;    // runs for a while after pointer or keys moved: they are read
    QTimer touch_timer_;   // runs while finer ground may come below the stylus
    QTimer still_timer_;   // runs out when nothing has moved for a while
    std::chrono::steady_clock::time_point last_paint_{};

    CapRates cap_; // that moved the camera last, since it was at rest

    Tool tool_ = Tool::Pan;
    PlaceTool* place_tool_ = nullptr;
    MapCursor map_cursor_ = MapCursor::Arrow;
    MapAction drag_action_ = MapAction::None;
    Qt::MouseButton drag_button_ = Qt::NoButton;
    bool may_be_click_ = false; // the drag has not left the place where it began
    QPointF drag_position_;
    double grabbed_z_m_ = 0.0;       // of what the drag, or the stylus, has hold of
    std::optional<QPointF> pointer_; // over the map, and not over an overlay
    bool is_keyboard_used_ = false;  // to navigate, since the pointer moved last
    struct TypedPlace {
        ScenePoint place;
        OrbitCamera goal; // that looks at it
    };
    std::optional<TypedPlace> typed_place_;
    bool is_read_elsewhere_ = false;
    bool is_crosshair_allowed_ = true;
    bool was_crosshair_shown_ = false;
    bool is_pointer_over_terrain_ = false;
    StylusButtons buttons_;
    bool has_hand_moved_ = false; // since it began to press
    Stylus stylus_;
    std::optional<StylusPose> device_;
    QLabel* empty_hint_ = nullptr;
};

} // namespace marsview
