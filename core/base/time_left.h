// How long something will go on, told from how it has gone so far.
#pragma once

#include <chrono>
#include <optional>

namespace marsview {

/// The rate of progress, the recent minute counting most, carried on to the end. Pure: the caller
/// says what time it is.
class TimeLeft {
public:
    /// `fraction` in [0, 1] of the work is done `now`, which counts from any moment and does not
    /// go back.
    void report(double fraction, std::chrono::nanoseconds now);

    /// Nothing until a few seconds of progress have been seen, and while there is none.
    std::optional<std::chrono::seconds> left() const;

private:
    struct Point {
        double fraction = 0.0;
        std::chrono::nanoseconds time{};
    };

    std::optional<Point> begin_; // from which on progress counts
    Point last_;
    double progress_ = 0.0; // sums with weights that fade with time
    double seconds_ = 0.0;
    bool is_settled_ = false;
};

} // namespace marsview
