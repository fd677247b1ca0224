#include "ui/views/camera_flight.h"

#include "ui/canvas/terrain_view.h"

#include <QScopedValueRollback>

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

constexpr std::chrono::milliseconds kFlightFrame{16};

} // namespace

CameraFlight::CameraFlight(TerrainView& view, QObject* parent)
    : QObject(parent)
    , view_(view)
{
    timer_.setTimerType(Qt::PreciseTimer);
    timer_.setInterval(kFlightFrame);
    connect(&timer_, &QTimer::timeout, this, &CameraFlight::advance);
    connect(&view_, &TerrainView::sightChanged, this, [this] {
        // A change of the window's size changes what is in sight too, but not the camera.
        if (isPlaying() && !is_moving_ && (view_.isMoving() || view_.camera() != set_)) {
            interrupt();
        }
    });
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
    if (view_.isMoving()) { // the next position of the path would end this motion unseen
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
        view_.setCamera(path_->at(share));
        set_ = view_.camera();
    }
    Q_EMIT moved(share);
    if (share >= 1.0 && isPlaying()) {
        stop();
        Q_EMIT finished();
    }
}

} // namespace marsview
