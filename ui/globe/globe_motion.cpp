#include "ui/globe/globe_motion.h"

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

constexpr std::chrono::milliseconds kFrame{16};

} // namespace

GlobeMotion::GlobeMotion(Bound bound, QObject* parent)
    : QObject(parent)
    , bound_(std::move(bound))
{
    timer_.setTimerType(Qt::PreciseTimer);
    timer_.setInterval(kFrame);
    connect(&timer_, &QTimer::timeout, this, &GlobeMotion::advance);
}

void GlobeMotion::jumpTo(const BodyCamera& camera)
{
    timer_.stop();
    camera_ = bound_(camera);
    goal_ = camera_;
    Q_EMIT cameraChanged();
}

void GlobeMotion::follow(Path path, std::chrono::milliseconds duration)
{
    path_ = std::move(path);
    goal_ = bound_(path_(1.0));
    duration_ = duration;
    clock_.start();
    timer_.start();
}

double GlobeMotion::share() const
{
    if (!isMoving()) {
        return 1.0;
    }
    const double rest = 1.0 - std::min(1.0, static_cast<double>(clock_.elapsed()) /
                                                static_cast<double>(duration_.count()));
    return 1.0 - rest * rest * rest;
}

void GlobeMotion::stop()
{
    timer_.stop();
    goal_ = camera_;
}

void GlobeMotion::advance()
{
    const double share_now = share();
    camera_ = bound_(path_(share_now));
    if (share_now >= 1.0) {
        stop();
    }
    Q_EMIT cameraChanged();
}

} // namespace marsview
