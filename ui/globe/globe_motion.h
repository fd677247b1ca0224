// The camera over a body in time: jumps, and motions that any input may interrupt.
#pragma once

#include "core/globe/body_camera.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include <chrono>
#include <functional>

namespace marsview {

/// Holds the camera and moves it, within bounds all the way. Its timer runs only while it moves.
class GlobeMotion final : public QObject {
    Q_OBJECT

public:
    using Bound = std::function<BodyCamera(const BodyCamera&)>;
    /// The camera at a share of the way, 0 to 1.
    using Path = std::function<BodyCamera(double share)>;

    explicit GlobeMotion(Bound bound, QObject* parent = nullptr);

    const BodyCamera& camera() const noexcept { return camera_; }
    /// Where the camera will be when it has come to rest.
    const BodyCamera& goal() const noexcept { return goal_; }
    bool isMoving() const noexcept { return timer_.isActive(); }

    void jumpTo(const BodyCamera& camera);
    /// Along `path`, at full speed first, gently coming to rest.
    void follow(Path path, std::chrono::milliseconds duration);
    /// How much of the way of the motion is done; 1 at rest.
    double share() const;
    void stop();

Q_SIGNALS:
    void cameraChanged();

private:
    void advance();

    Bound bound_;
    Path path_;
    BodyCamera camera_;
    BodyCamera goal_;
    QElapsedTimer clock_;
    QTimer timer_;
    std::chrono::milliseconds duration_{1};
};

} // namespace marsview
