// Moving the camera of a scene along a path, until the path ends or the user takes the camera.
#pragma once

#include "core/flight/camera_path.h"
#include "ui/pictures/picture_scenes.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include <chrono>
#include <optional>

namespace marsview {

/// A motion by anything else, such as the mouse, a key or another layer on top, ends the flight.
/// Its timer runs only while it plays. Lives in the GUI thread; the scenes outlive it.
class CameraFlight final : public QObject {
    Q_OBJECT

public:
    explicit CameraFlight(const PictureScenes& scenes, QObject* parent = nullptr);

    /// Plays from `share` of the path on; `duration` (> 0) is that of the whole path.
    void play(CameraPath path, std::chrono::milliseconds duration, double share = 0.0);
    bool isPlaying() const noexcept { return timer_.isActive(); }
    /// Leaves the camera where it is.
    void stop();

Q_SIGNALS:
    /// The camera is at this share of the path's time.
    void moved(double share);
    /// The end of the path.
    void finished();
    /// Something else moved the camera.
    void interrupted();

private:
    PictureScene& scene() const;
    void noteSight(const PictureScene& moved);
    void advance();
    void show(double share);
    void interrupt();

    PictureScenes scenes_;
    std::optional<CameraPath> path_;
    std::chrono::milliseconds duration_{1};
    double begin_ = 0.0;
    QElapsedTimer clock_;
    QTimer timer_;
    SceneCamera set_;        // where the flight left the camera last
    bool is_moving_ = false; // by this flight, at this moment
};

} // namespace marsview
