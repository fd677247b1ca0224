// Moves the camera over the globe: steps, flights, zooms, jumps and a cap, within limits.
#pragma once

#include "core/globe/body_motion.h"
#include "core/view/cap_steering.h"
#include "ui/canvas/camera_controller.h"
#include "ui/globe/globe_ground.h"
#include "ui/globe/globe_motion.h"

#include <QObject>

#include <chrono>
#include <functional>

namespace marsview {

/// Keeps the camera above the terrain and the terrain in the picture. Motions have no effect over
/// an empty globe. GUI thread.
class GlobeCamera final : public QObject {
    Q_OBJECT

public:
    /// `ground` outlives this. `viewport` gives the size of the picture.
    GlobeCamera(const GlobeGround& ground, std::function<Viewport()> viewport);

    const BodyCamera& camera() const noexcept { return motion_.camera(); }
    /// Where the camera will be when it has come to rest.
    const BodyCamera& goal() const noexcept { return motion_.goal(); }
    /// Where the camera is. Not over an empty globe; nor are those that follow.
    CameraPose pose() const { return poseOf(motion_.camera(), ground_.ellipsoid()); }
    Ray rayThrough(PixelPoint pixel) const;
    bool isMoving() const noexcept { return motion_.isMoving(); }

    void jumpTo(const BodyCamera& camera) { motion_.jumpTo(camera); }
    void stop() { motion_.stop(); }
    /// Shows all layers, at once.
    void jumpHome() { motion_.jumpTo(homeView()); }
    /// The exaggeration was changed by a factor: along with the terrain, at once.
    void followTerrain(double factor);

    void step(NavigationStep step);
    /// As SteeredView::steer().
    void steer(const CapRates& rates, double seconds);
    void goHome();
    void turnNorthUp();
    /// Along a great circle.
    void flyTo(const BodyCamera& camera);
    /// To a place from the same side; `distance_m` of 0 keeps the distance.
    void flyTo(const GeographicPoint& place, double distance_m);
    /// To a place and much nearer to it.
    void flyNearer(const GeographicPoint& place);
    /// To where all of a layer is in sight, from the same side unless it is seen as a ball.
    void flyTo(const BodyTerrain& map);
    /// At once, from the same distance and side, or with another azimuth.
    void lookAt(const GeographicPoint& place, std::optional<Angle> azimuth = {});

    /// The ground at a pixel, which a drag or a zoom holds; off the body, the nearest point of its
    /// edge.
    HeldPoint hold(PixelPoint pixel) const;
    /// So that a point that is held is at its pixel.
    void pull(const HeldPoint& held);
    /// Around the target.
    void orbit(Angle turn, Angle tilt);
    /// The target of a camera at rest becomes the terrain in the middle of the picture.
    void aimAtGround() { motion_.jumpTo(onGround(motion_.camera())); }
    /// By a factor of the distance, while a point that is held stays at its pixel; further factors
    /// are added to a zoom in progress.
    void zoom(double factor, const HeldPoint& held, std::chrono::milliseconds duration);
    /// The same at once.
    void zoomAtOnce(double factor, const ScenePoint& held);

Q_SIGNALS:
    void cameraChanged();

private:
    BodyCamera bounded(const BodyCamera& camera) const;
    BodyCamera onGround(const BodyCamera& camera) const;
    BodyCamera homeView() const;
    void fly(const BodyCamera& goal, std::chrono::milliseconds duration);

    const GlobeGround& ground_;
    std::function<Viewport()> viewport_;
    GlobeMotion motion_;
    CapRates cap_;           // that moved the camera last
    double zoom_left_ = 1.0; // the whole factor of the zoom in progress
    bool is_zooming_ = false;
};

} // namespace marsview
