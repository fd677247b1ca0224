// Estimates the remaining time of a job from its progress so far.
#pragma once

#include <chrono>
#include <optional>

namespace marsview {

/// Extrapolates the rate of progress, weighted towards the last minute. Pure: the caller supplies
/// the time.
class TimeLeft {
public:
    /// `fraction` in [0, 1] of the work is done `now`, which counts from any moment and does not
    /// go back.
    void report(double fraction, std::chrono::nanoseconds now);

    /// Empty until a few seconds of progress have been reported, and without any progress.
    std::optional<std::chrono::seconds> left() const;

private:
    struct Point {
        double fraction = 0.0;
        std::chrono::nanoseconds time{};
    };

    std::optional<Point> begin_; // where progress counts from
    Point last_;
    double progress_ = 0.0; // sums whose weights decay with time
    double seconds_ = 0.0;
    bool is_settled_ = false;
};

} // namespace marsview
