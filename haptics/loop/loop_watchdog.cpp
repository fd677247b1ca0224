#include "haptics/loop/loop_watchdog.h"

#include <cstdint>
#include <utility>

namespace marsview {

LoopWatchdog::LoopWatchdog(std::shared_ptr<ServoCore> core, bool waits_for_first)
    : thread_([core = std::move(core), shared = shared_, waits_for_first] {
        watch(*core, *shared, waits_for_first);
    })
{}

LoopWatchdog::~LoopWatchdog()
{
    constexpr std::chrono::milliseconds kPatience{100};
    if (!endWithin(kPatience)) {
        thread_.leave();
    }
}

bool LoopWatchdog::endWithin(std::chrono::milliseconds patience)
{
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->is_ending = true;
        shared_->wake.notify_all();
    }
    return thread_.joinWithin(patience);
}

void LoopWatchdog::watch(ServoCore& core, Shared& shared, bool waits_for_first)
{
    std::uint64_t seen = core.beats();
    // Counted in polls and not by the clock: a process that was stopped as a whole, by a debugger
    // or on an overloaded machine, was not silent all that time.
    std::chrono::milliseconds silence{0};
    std::unique_lock lock(shared.mutex);
    while (!shared.wake.wait_for(lock, kLook, [&] { return shared.is_ending; })) {
        const std::uint64_t beats = core.beats();
        if (beats != seen || (beats == 0 && waits_for_first)) {
            seen = beats;
            silence = {};
            core.setStalled(false);
            continue;
        }
        silence += kLook;
        if (core.hasEnded()) {
            continue; // as expected
        }
        if (silence >= kStalled && beats > 0) {
            core.setStalled(true);
            lock.unlock(); // the device may hang
            core.bringToRest();
            lock.lock();
        }
        if (silence >= kDead) {
            core.setStalled(true);
            core.giveUp();
        }
    }
}

} // namespace marsview
