// The view of the map, with the styluses of the mouse and the device.
#pragma once

#include "ui/canvas/camera_controller.h"
#include "ui/canvas/grab_key.h"
#include "ui/canvas/map_mouse.h"
#include "ui/canvas/place_reader.h"
#include "ui/canvas/shown_scene.h"
#include "ui/canvas/sight_memory.h"
#include "ui/canvas/steered_view.h"
#include "ui/canvas/terrain_canvas.h"
#include "ui/canvas/touch_tool.h"
#include "ui/canvas/view_projection.h"

#include <QOpenGLWidget>

#include <chrono>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

class QLabel;

namespace marsview {

/// Joins the scene, the camera, the canvas that draws them, and the tools; passes events on to
/// them.
class TerrainView final : public QOpenGLWidget, public SteeredView, private CanvasScene {
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
    const std::vector<ShownLayer>& shownLayers() const noexcept { return scene_.layers(); }
    /// `map` is about to replace `preview` and takes over its view. Call before setLayers().
    void replacePreview(const std::shared_ptr<const Map>& preview,
                        const std::shared_ptr<const Map>& map);
    /// The topmost map shown; none where there is none.
    const std::shared_ptr<const Map>& map() const noexcept { return scene_.map(); }
    /// Its color ramp; null without a map.
    const ColorRamp* ramp() const noexcept { return scene_.ramp(); }
    /// Everything that is shown.
    const SceneSurface& ground() const noexcept { return scene_.ground(); }

    /// The text in the middle of an empty view; if empty, what to do about it.
    void setHint(const QString& hint);
    /// There are layers, but the user has hidden all of them.
    void setAllHidden(bool is_so);
    void setLook(const TerrainLook& look);
    const TerrainLook& look() const noexcept { return scene_.style.look; }
    void setAntialiasing(bool is_wanted) { canvas_.setAntialiasing(is_wanted); }
    /// The time that a frame may take while something moves.
    void setFrameTarget(std::chrono::milliseconds target) { canvas_.setFrameTarget(target); }

    const OrbitCamera& camera() const noexcept { return camera_.camera(); }
    /// Where the camera will be when it has come to rest.
    const OrbitCamera& cameraGoal() const noexcept { return camera_.goal(); }
    /// Of the picture, in pixels of the frame buffer.
    Viewport viewport() const { return viewportOf(*this); }
    /// Jumps, within the limits.
    void setCamera(const OrbitCamera& camera) { camera_.jumpTo(camera); }
    bool isMoving() const noexcept override { return camera_.isMoving(); }
    /// The camera has not moved since the map was opened.
    bool isAtOpeningView() const noexcept { return camera_.isAtOpeningView(); }

    double exaggeration() const noexcept { return scene_.style.exaggeration; }
    /// Keeps the piece of ground in the middle of the picture there.
    void setExaggeration(double exaggeration);

    /// What moves the stylus' proxy.
    void setContactModel(ContactModelKind model) { touch_.setModel(model); }
    ContactModelKind contactModel() const noexcept { return touch_.model(); }

    /// What a drag with the left button does; Pan to begin with. A drag that is under way ends.
    void setTool(Tool tool) { mouse_.setTool(tool); }
    Tool tool() const noexcept { return mouse_.tool(); }
    /// Hears of clicks, drags and keys while `tool` is chosen. Null for none; otherwise it outlives
    /// the view or is taken back before.
    void setPlaceTool(Tool tool, PlaceTool* place_tool) { mouse_.setPlaceTool(tool, place_tool); }
    /// Lines on the terrain, drawn over every picture.
    void setLines(std::vector<DrapedLine> lines, LineSet set)
    {
        canvas_.setLines(std::move(lines), set);
    }
    void setDots(DotSet dots, LineSet set) { canvas_.setDots(std::move(dots), set); }

    void step(NavigationStep step);
    void steer(const CapRates& rates, double seconds) override { camera_.steer(rates, seconds); }
    void goHome() override;
    void turnNorthUp();
    /// Flies to a place of the topmost layer; `distance_m` of 0 keeps the distance.
    void flyTo(GridPoint grid, double distance_m) { camera_.flyTo(grid, distance_m); }
    /// The same at the same distance, with the focus, for a place that was typed: it is what is
    /// read until the pointer or the camera moves.
    void goTo(GridPoint grid);
    /// The same to a place of the scene, from the same side and distance.
    void flyToPlace(const ScenePoint& place) { camera_.flyToPlace(place); }
    /// Flies to what surfaceAt() found, and much nearer to it.
    void flyNearer(const RayHit& hit) { camera_.flyNearer(hit.grid, devicePixelRatioF()); }
    /// Flies until the camera is this one, within the limits.
    void flyTo(const OrbitCamera& camera) { camera_.flyTo(camera); }
    /// Looks at a place of the scene at once, from the same side and distance.
    void lookAt(const ScenePoint& place) { camera_.lookAt(place); }

    /// The ground behind a position in widget coordinates, at full resolution: where it is on the
    /// topmost map's grid, which lower maps may reach beyond. Where a map has no data, the place
    /// there, with a height of NaN.
    std::optional<RayHit> surfaceAt(QPointF position) const;
    /// The same with the map that it is on, and the place on that map's own grid.
    std::optional<GroundPoint> placeUnder(QPointF position) const
    {
        return projection_.placeUnder(position);
    }
    /// The place that is read: under the stylus of a haptic device, unless the pointer or a key has
    /// just moved; otherwise under the pointer; or at the crosshair in the middle of the picture,
    /// while the view has the focus and the pointer is not over it or a key moved the camera last.
    /// Nothing where no surface is there.
    std::optional<RayHit> reading() const { return reader_.reading(); }
    /// What reading() is the place of.
    ReadingSource readingSource() const { return reader_.source(); }
    bool isCrosshairShown() const { return reader_.isCrosshairShown(); }
    /// Meters on the terrain in one point of the screen at a place that surfaceAt() found.
    double metersPerPoint(const RayHit& hit) const;
    /// Emits pointerMoved() with what is there now.
    void readAgain() { reader_.report(); }
    /// Keeps the crosshair while another widget that shows the reading has the focus.
    void setReadElsewhere(bool is_read) { reader_.setReadElsewhere(is_read); }
    /// False for pictures of the window: no crosshair in them.
    void setCrosshairAllowed(bool is_allowed) { reader_.setCrosshairAllowed(is_allowed); }
    /// A position of the topmost map's surface in widget coordinates.
    std::optional<QPointF> positionOf(GridPoint grid) const;
    /// A place of the scene in widget coordinates; nothing where it is behind the eye.
    std::optional<QPointF> positionOfPlace(const ScenePoint& place) const
    {
        return projection_.positionOf(place);
    }
    /// Whether nothing but ground before it can hide a place of the scene.
    bool isInPicture(const ScenePoint& place) const { return projection_.isInPicture(place); }

    /// There is a graphics context.
    bool isReady() const noexcept { return canvas_.isReady(); }
    /// True when the picture shows all there is, as well as can be, and nothing moves.
    bool isPictureComplete() const { return canvas_.isComplete() && !camera_.isMoving(); }
    /// See problemChanged().
    const QString& problem() const noexcept { return canvas_.problem(); }
    const std::optional<StylusPose>& stylus() const noexcept { return touch_.pose(); }
    /// Where a haptic device has its stylus; nothing for none.
    void showDevice(const std::optional<StylusPose>& pose);
    /// Whether the chosen tool places points: the button of a device's stylus is for it.
    bool isPlacing() const { return mouse_.isPlacing(); }
    /// That button, with the stylus at a place of the scene.
    void pressStylus(const ScenePoint& place) { mouse_.pressStylus(place); }
    void releaseStylus() { mouse_.releaseStylus(); }
    /// The stylus drawn: the device's, unless the mouse presses or grabs with the Touch tool. The
    /// mouse has a stylus with the Touch tool only.
    const std::optional<StylusPose>& shownStylus() const noexcept { return touch_.shown(); }
    /// The picture of the terrain alone, without cursor.
    QImage terrainPicture() { return canvas_.terrainPicture(); }
    /// The exaggeration and look of now.
    const DrawStyle& style() const noexcept override { return scene_.style; }
    /// A part of the picture of any size that `camera` has, into `picture`, RGB888 of that size.
    /// False, and nothing drawn, while pieces of it are missing: they are on their way.
    Result<bool> drawPart(const OrbitCamera& camera,
                          const DrawStyle& style,
                          const QRect& part,
                          const PartOptions& options,
                          QImage& picture)
    {
        return canvas_.drawPart({.camera = camera}, style, part, options, picture);
    }
    /// Pixels a side that the graphics driver draws; 0 without a graphics context.
    int pictureSideMax() { return canvas_.pictureSideMax(); }

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
    /// The grab key was pressed or released for a device.
    void grabbingChanged(bool is_grabbing);
    void toolChanged(Tool tool);
    /// A gesture of the mouse moved the camera or the stylus, or asked for the menu.
    void gestureMade(MapAction action);
    /// The context menu of what lies at a position in widget coordinates is asked for.
    void menuRequested(QPointF position);
    /// A position was clicked with a tool that places no points.
    void clicked(QPointF position);

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
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;
    void childEvent(QChildEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;
    void leaveEvent(QEvent* event) override;

private:
    std::vector<TerrainLayer> terrainLayers() const override;
    CanvasCamera canvasCamera() const override { return {.camera = camera_.camera()}; }
    bool isTouching() const noexcept override { return touch_.isTouching(); }
    std::optional<CursorPicture> canvasCursor() const override;
    std::optional<ScenePoint>
    groundUnderCursor(const CursorPicture& cursor, double right_m, double ahead_m) const override;
    void connectParts();
    void reportUnavailable(const QString& reason);
    void releaseGraphics() { canvas_.release(); }
    void setGrabbing(bool is_grabbing);

    ShownScene scene_;
    SightMemory sights_;
    CameraController camera_;
    ViewProjection projection_;
    TouchTool touch_;
    GrabKey grab_key_;
    PlaceReader reader_;
    MapMouse mouse_;
    TerrainCanvas canvas_;
    bool is_context_missing_ = false;
    QLabel* empty_hint_ = nullptr;
    QString hint_; // set, while a map is opened
    bool is_all_hidden_ = false;
};

} // namespace marsview
