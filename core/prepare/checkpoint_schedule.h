// When a long job saves its next checkpoint.
#pragma once

#include <algorithm>
#include <chrono>

namespace marsview {

/// A checkpoint is due after each interval, or later if saving one takes more than a twentieth of
/// the time. For one thread.
class CheckpointSchedule {
public:
    using Clock = std::chrono::steady_clock;

    /// With an interval of zero, a checkpoint is always due.
    explicit CheckpointSchedule(std::chrono::milliseconds interval)
        : interval_(interval)
        , next_(Clock::now() + interval)
    {}

    Clock::time_point next() const noexcept { return next_; }
    bool isDue() const { return Clock::now() >= next_; }

    /// Calls `save`, which returns whether there is a new checkpoint, and plans the next one.
    template <typename Save>
    bool run(Save&& save)
    {
        const Clock::time_point start = Clock::now();
        const bool is_saved = save();
        const Clock::time_point end = Clock::now();
        next_ = interval_.count() == 0
                    ? end
                    : end + std::max<Clock::duration>(interval_, kWorkPerSave * (end - start));
        return is_saved;
    }

private:
    static constexpr int kWorkPerSave = 20;

    std::chrono::milliseconds interval_;
    Clock::time_point next_;
};

} // namespace marsview
