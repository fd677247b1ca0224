// The camera over time: jumps, and motions that any input may interrupt.
#pragma once

#include "core/view/camera.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include <chrono>
#include <functional>

namespace marsview {

/// Returns the nearest allowed camera: an allowed camera itself.
using CameraBound = std::function<OrbitCamera(const OrbitCamera&)>;

/// Holds the camera and moves it towards a goal, within bounds all the way. Its timer runs only
/// while it moves.
class Navigator final : public QObject {
    Q_OBJECT

public:
    explicit Navigator(CameraBound bound, QObject* parent = nullptr);

    const OrbitCamera& camera() const noexcept { return camera_; }
    /// Where the camera will be when it has come to rest.
    const OrbitCamera& goal() const noexcept { return goal_; }
    bool isMoving() const noexcept { return timer_.isActive(); }

    void jumpTo(const OrbitCamera& camera);
    void moveTo(const OrbitCamera& goal, std::chrono::milliseconds duration);
    /// Stops the camera at its present position.
    void stop();

Q_SIGNALS:
    void cameraChanged(const OrbitCamera& camera);

private:
    void advance();

    CameraBound bound_;
    OrbitCamera camera_;
    OrbitCamera start_;
    OrbitCamera goal_;
    QElapsedTimer clock_;
    QTimer timer_;
    std::chrono::milliseconds duration_{0};
};

} // namespace marsview
