#include "ui/canvas/navigator.h"

#include "core/view/navigation.h"

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

constexpr std::chrono::milliseconds kFrame{16};

// Starts at full speed, so that an input has an effect at once, and comes to rest gently.
double eased(double t)
{
    const double rest = 1.0 - t;
    return 1.0 - rest * rest * rest;
}

} // namespace

Navigator::Navigator(CameraBound bound, QObject* parent)
    : QObject(parent)
    , bound_(std::move(bound))
{
    timer_.setTimerType(Qt::PreciseTimer);
    timer_.setInterval(kFrame);
    connect(&timer_, &QTimer::timeout, this, &Navigator::advance);
}

void Navigator::jumpTo(const OrbitCamera& camera)
{
    timer_.stop();
    camera_ = bound_(camera);
    goal_ = camera_;
    Q_EMIT cameraChanged(camera_);
}

void Navigator::moveTo(const OrbitCamera& goal, std::chrono::milliseconds duration)
{
    start_ = camera_;
    goal_ = bound_(goal);
    duration_ = duration;
    clock_.start();
    timer_.start();
}

void Navigator::stop()
{
    timer_.stop();
    goal_ = camera_;
}

void Navigator::advance()
{
    const double t = static_cast<double>(clock_.elapsed()) / static_cast<double>(duration_.count());
    // Between two cameras that are allowed there may be a mountain.
    camera_ = bound_(interpolated(start_, goal_, eased(std::min(t, 1.0))));
    if (t >= 1.0) {
        stop();
    }
    Q_EMIT cameraChanged(camera_);
}

} // namespace marsview
