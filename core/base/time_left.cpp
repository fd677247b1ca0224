#include "core/base/time_left.h"

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

using std::chrono::duration;
using std::chrono::milliseconds;
using std::chrono::seconds;

// Resumed work and cached data pass in a moment and say nothing about the rate.
constexpr milliseconds kSettling{1000};

// Time for which progress must be seen before the first estimate.
constexpr seconds kSeenMin{3};

// Reports closer together than this are merged.
constexpr milliseconds kStep{200};

// Reports older than this weigh less than a third.
constexpr double kMemorySeconds = 40.0;

} // namespace

void TimeLeft::report(double fraction, std::chrono::nanoseconds now)
{
    const Point point{fraction, now};
    if (!begin_) {
        begin_ = point;
        last_ = point;
        return;
    }
    if (!is_settled_) {
        if (now - begin_->time < kSettling) {
            return;
        }
        is_settled_ = true;
        begin_ = point;
        last_ = point;
        return;
    }
    if (now - last_.time < kStep) {
        return;
    }
    const double step_s = duration<double>(now - last_.time).count();
    const double fading = std::exp(-step_s / kMemorySeconds);
    progress_ = progress_ * fading + std::max(0.0, fraction - last_.fraction);
    seconds_ = seconds_ * fading + step_s;
    last_ = point;
}

std::optional<std::chrono::seconds> TimeLeft::left() const
{
    if (!is_settled_ || last_.time - begin_->time < kSeenMin || !(progress_ > 0.0)) {
        return std::nullopt;
    }
    const double left_s = (1.0 - last_.fraction) * seconds_ / progress_;
    constexpr double kLongest = 3600.0 * 24.0 * 365.0;
    return seconds(static_cast<seconds::rep>(std::ceil(std::clamp(left_s, 0.0, kLongest))));
}

} // namespace marsview
