// Moves the camera over the scene: steps, flights, jumps and a cap, within limits.
#pragma once

#include "core/view/cap_steering.h"
#include "core/view/navigation.h"
#include "ui/canvas/navigator.h"
#include "ui/canvas/shown_scene.h"

#include <QObject>

#include <chrono>
#include <functional>

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

/// Keeps the camera above the terrain and the terrain in the picture. Motions have no effect in an
/// empty scene.
class CameraController final : public QObject {
    Q_OBJECT

public:
    /// `scene` outlives this. `viewport` gives the size of the picture.
    CameraController(const ShownScene& scene, std::function<Viewport()> viewport);

    const OrbitCamera& camera() const noexcept { return navigator_.camera(); }
    /// Where the camera will be when it has come to rest.
    const OrbitCamera& goal() const noexcept { return navigator_.goal(); }
    bool isMoving() const noexcept { return navigator_.isMoving(); }
    Viewport viewport() const { return viewport_(); }
    NavigationLimits limits() const;

    void jumpTo(const OrbitCamera& camera);
    void moveTo(const OrbitCamera& goal, std::chrono::milliseconds duration);
    void stop() { navigator_.stop(); }

    void step(NavigationStep step);
    /// As a cap is pushed, for the time since the last call; once at rest to end with. Draws
    /// nothing where the camera stays where it is.
    void steer(const CapRates& rates, double seconds);
    void goHome();
    void turnNorthUp();
    void flyTo(const OrbitCamera& camera);
    /// To a place of the topmost layer; `distance_m` of 0 keeps the distance.
    void flyTo(GridPoint grid, double distance_m);
    /// From the same side and distance.
    void flyToPlace(const ScenePoint& place);
    /// To a place of the topmost layer and much nearer to it, until a sample of the finest layer is
    /// as large as some points of the screen.
    void flyNearer(GridPoint grid, double pixels_per_point);
    /// At once, from the same side and distance.
    void lookAt(const ScenePoint& place);

    /// Jumps to the opening view of the topmost map, and again at resize() until the camera moves.
    void goToOpeningView();
    /// The camera has not moved since.
    bool isAtOpeningView() const noexcept { return is_at_opening_view_; }
    /// The size of the picture changed.
    void resize();
    /// The exaggeration of the scene is about to change: the goal of a motion in progress.
    OrbitCamera goalOnGround() const;
    /// The exaggeration changed: jumps along with the terrain. An opening view stays one.
    void followTerrain(const OrbitCamera& camera) { navigator_.jumpTo(camera); }

    /// The same picture, its target on the terrain in the middle of it.
    OrbitCamera onGround(const OrbitCamera& camera) const;
    /// The camera from which a zoom by `factor` starts.
    OrbitCamera beforeZoom(double factor) const;

Q_SIGNALS:
    void cameraChanged();

private:
    OrbitCamera bounded(const OrbitCamera& camera) const;
    OrbitCamera wholeView() const;
    OrbitCamera lookingAt(const ScenePoint& place, const OrbitCamera& camera) const;

    const ShownScene& scene_;
    std::function<Viewport()> viewport_;
    Navigator navigator_;
    CapRates cap_;                    // that moved the camera last, since it was at rest
    bool is_at_opening_view_ = false; // the camera has not moved since
};

} // namespace marsview
