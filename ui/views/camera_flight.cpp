#include "ui/views/camera_flight.h"

#include <QScopedValueRollback>

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

constexpr std::chrono::milliseconds kFlightFrame{16};

} // namespace

CameraFlight::CameraFlight(const PictureScenes& scenes, QObject* parent)
    : QObject(parent)
    , scenes_(scenes)
{
    timer_.setTimerType(Qt::PreciseTimer);
    timer_.setInterval(kFlightFrame);
    connect(&timer_, &QTimer::timeout, this, &CameraFlight::advance);
    for (PictureScene* scene : {&scenes_.flat, &scenes_.globe}) {
        connect(scene, &PictureScene::sightChanged, this, [this, scene] { noteSight(*scene); });
    }
}

PictureScene& CameraFlight::scene() const
{
    return scenes_.of(*path_);
}

// A change of the window's size changes what is in sight too, but not the camera.
void CameraFlight::noteSight(const PictureScene& moved)
{
    if (isPlaying() && !is_moving_ && &moved == &scene() &&
        (moved.isMoving() || moved.camera() != set_)) {
        interrupt();
    }
}

void CameraFlight::play(CameraPath path, std::chrono::milliseconds duration, double share)
{
    path_ = std::move(path);
    duration_ = duration;
    begin_ = std::clamp(share, 0.0, 1.0);
    clock_.start();
    timer_.start();
    show(begin_);
}

void CameraFlight::stop()
{
    timer_.stop();
}

void CameraFlight::interrupt()
{
    stop();
    Q_EMIT interrupted();
}

void CameraFlight::advance()
{
    if (scene().isMoving() ||
        &scene() !=
            &scenes_.shown()) { // the next position of the path would end this motion unseen
        interrupt();
        return;
    }
    show(std::min(begin_ + static_cast<double>(clock_.elapsed()) /
                               static_cast<double>(duration_.count()),
                  1.0));
}

void CameraFlight::show(double share)
{
    {
        const QScopedValueRollback moving(is_moving_, true);
        scene().setCamera(scene().cameraOn(*path_, share));
        set_ = scene().camera();
    }
    Q_EMIT moved(share);
    if (share >= 1.0 && isPlaying()) {
        stop();
        Q_EMIT finished();
    }
}

} // namespace marsview
