// The map on screen, and the hands on it.
#pragma once

#include "core/terrain/ray_cast.h"
#include "core/view/navigation.h"
#include "core/view/terrain_look.h"
#include "core/session/loaded_map.h"
#include "ui/navigator.h"
#include "ui/render/terrain_renderer.h"

#include <QOpenGLWidget>

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

class QLabel;

namespace marsview {

/// What a drag of the mouse does.
enum class DragAction { None, Pan, Orbit };

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

/// Hosts the renderer and turns input into motions of the camera. Draws only when something
/// changed.
class TerrainView final : public QOpenGLWidget {
    Q_OBJECT

public:
    explicit TerrainView(QWidget* parent = nullptr);
    ~TerrainView() override;

    /// Puts these layers in place of those shown, top first; none for an empty view. All lie in one
    /// CRS. The change becomes visible, and mapShown() is emitted, when the picture is whole. The
    /// camera stays where the topmost layers lie alike, otherwise it goes to the new one's opening
    /// view.
    void setLayers(const std::vector<ShownLayer>& top_first);
    /// The topmost map in the picture.
    const LoadedMap& map() const noexcept { return map_; }

    void setLook(const TerrainLook& look);
    const TerrainLook& look() const noexcept { return look_; }
    void setAntialiasing(bool is_wanted);
    /// The time that a frame may take while something moves.
    void setFrameTarget(std::chrono::milliseconds target);

    const OrbitCamera& camera() const noexcept { return navigator_.camera(); }
    /// Jumps, within the limits.
    void setCamera(const OrbitCamera& camera);
    bool isMoving() const noexcept { return navigator_.isMoving(); }

    double exaggeration() const noexcept { return style_.exaggeration; }
    /// Keeps the piece of ground in the middle of the picture there.
    void setExaggeration(double exaggeration);

    void step(NavigationStep step);
    void goHome();
    void turnNorthUp();
    /// Flies to a place of the topmost layer; `distance_m` of 0 keeps the distance.
    void flyTo(GridPoint grid, double distance_m);

    /// The surface behind a position in widget coordinates, at full resolution.
    std::optional<RayHit> surfaceAt(QPointF position) const;
    /// A position of the surface in widget coordinates.
    std::optional<QPointF> positionOf(GridPoint grid) const;
    /// True when the picture shows all there is of the map and nothing moves.
    bool isPictureComplete() const;

Q_SIGNALS:
    /// There is a graphics context; nothing can be loaded for drawing before.
    void ready(const RenderLimits& limits);
    /// There is none that will do.
    void unavailable(const QString& reason);
    void mapShown(const LoadedMap& map);
    void pictureCompleted();
    /// What is under the pointer changed; nothing where it is not over the surface.
    void pointerMoved(const std::optional<RayHit>& hit);
    void exaggerationChanged(double exaggeration);
    /// The screen-space error of what is drawn, in pixels.
    void detailChanged(double pixels);

protected:
    void initializeGL() override;
    void paintGL() override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void leaveEvent(QEvent* event) override;

private:
    void setMap(const LoadedMap& map);
    void releaseGraphics();
    void showPendingMap();
    Viewport viewport() const;
    PixelPoint pixelAt(QPointF position) const;
    double groundAt(double east_m, double north_m) const;
    SceneBox box() const;
    NavigationLimits limits() const;
    OrbitCamera bounded(const OrbitCamera& camera) const;
    OrbitCamera onGround(const OrbitCamera& camera) const;
    OrbitCamera beforeZoom(double factor) const;
    ScenePoint anchorAt(QPointF position, const OrbitCamera& camera) const;
    void reportPointer();

    std::unique_ptr<TerrainRenderer> renderer_;
    Navigator navigator_;
    DrawStyle style_;
    TerrainLook look_;
    const ColorRamp* pending_ramp_ = nullptr;
    LoadedMap map_;
    LoadedMap pending_map_;
    bool is_pending_ = false;
    bool is_pending_sent_ = false;
    bool is_completion_reported_ = false;
    DragAction drag_action_ = DragAction::None;
    QPointF drag_position_;
    double grabbed_z_m_ = 0.0;
    std::optional<QPointF> pointer_;
    QLabel* empty_hint_ = nullptr;
};

} // namespace marsview
