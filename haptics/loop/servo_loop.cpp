#include "haptics/loop/servo_loop.h"

#include "haptics/device/watched_call.h"

#include <fmt/format.h>
#include <thread>
#include <utility>

namespace marsview {
namespace {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

nanoseconds periodOf(const DeviceCapabilities& device, nanoseconds otherwise)
{
    return device.rate_hz > 0.0 ? nanoseconds(static_cast<std::int64_t>(1e9 / device.rate_hz))
                                : otherwise;
}

constexpr const char* kHangs =
    "its driver does not respond; switch the device off, and "
    "restart the program";
constexpr const char* kSilent =
    "it has stopped requesting forces; switch it off, and connect it "
    "again";

} // namespace

ServoLoop::ServoLoop(std::unique_ptr<HapticDevice> device, const ServoLoopOptions& options)
    : options_(options)
    , owns_clock_(device->capabilities().owns_clock)
{
    const DeviceCapabilities& capabilities = device->capabilities();
    options_.thread.period = periodOf(capabilities, options_.thread.period);
    const ServoCoreOptions core{.tick = options_.tick.value_or(tickOptionsFor(capabilities)),
                                .period = options_.thread.period,
                                .uncounted_turns = options_.thread.uncounted_turns,
                                .ticks_max = options_.ticks_max,
                                .flight_ticks = options_.flight_ticks};
    core_ = std::make_shared<ServoCore>(std::move(device), core);
    options_.thread.memory = core_->memory();
}

ServoLoop::~ServoLoop()
{
    stop();
    if (is_abandoned_) {
        return;
    }
    // Drivers may also hang in closing.
    callWatched(2 * kPatience, [core = std::move(core_)]() mutable {
        core.reset();
        return true;
    });
}

void ServoLoop::set(const LoopSettings& settings)
{
    core_->settings().back() = settings;
    core_->settings().publish();
    const bool is_needed = settings.map != nullptr && !hasEnded();
    if (is_needed && !is_running_) {
        start();
    } else if (!is_needed && is_running_) {
        stop();
    }
}

void ServoLoop::start()
{
    core_->begin();
    if (owns_clock_) {
        if (const Status started = startClock(); !started) {
            giveUp(started.error().message);
            return;
        }
    } else {
        thread_.emplace(options_.thread, [core = core_, period = options_.thread.period,
                                          last_deadline =
                                              LoopTime{}](const LoopTick& tick) mutable noexcept {
            if (tick.is_preparation) {
                core->prepareTurn();
                return LoopOutcome::Continue;
            }
            const LoopTime now = steady_clock::now();
            // Skipped turns, or one that is later than a whole period.
            const bool has_missed = tick.number > 0 && (tick.deadline - last_deadline > period ||
                                                        now - tick.deadline > period);
            last_deadline = tick.deadline;
            return core->turn(now, has_missed);
        });
    }
    is_running_ = true;
    watchdog_.emplace(core_, !owns_clock_);
}

Status ServoLoop::startClock()
{
    const auto started = callWatched(kPatience, [core = core_] {
        return core->device().startClock(&ServoCore::deviceTick, core.get());
    });
    if (!started) {
        is_abandoned_ = true;
        core_->abandon();
        return Error{ErrorCode::Unreadable, kHangs};
    }
    if (!*started) {
        const std::string why = core_->device().trouble();
        return Error{ErrorCode::Unreadable, why.empty()
                                                ? "its clock could not be started; connect it again"
                                                : "its clock could not be started: " + why};
    }
    return Done{};
}

// Whether all ticks have ended.
bool ServoLoop::endClock()
{
    // Its thread ends when the vendor's does; the force ramps down in the meantime.
    constexpr int kWaitsMax = 100;
    for (int i = 0; i < kWaitsMax && !hasEnded(); ++i) {
        const LoopState state = core_->state();
        if (state.is_stalled || state.force_n == Vec3{}) {
            break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return callWatched(kPatience,
                       [core = core_] {
                           core->device().stopClock();
                           return true;
                       })
        .has_value();
}

void ServoLoop::stop()
{
    if (!is_running_) {
        return;
    }
    is_running_ = false;
    const bool was_stalled = isStalled();
    core_->askToEnd();
    // No driver can hang before the first tick, but RealtimeKit may take its time.
    const auto patience = core_->beats() == 0 ? 3 * kPatience : kPatience;
    bool is_over = owns_clock_ ? endClock() : thread_->joinWithin(patience);
    if (is_over) {
        // The watchdog has monitored the end; if the device hangs there, the watchdog hangs too.
        is_over = watchdog_->endWithin(kPatience) && callWatched(kPatience, [core = core_] {
                                                         core->device().write({});
                                                         return true;
                                                     }).has_value();
    }
    if (!is_over) {
        is_abandoned_ = true;
        core_->abandon();
        core_->setStalled(true);
        if (thread_) {
            last_statistics_ = thread_->latestStatistics().value_or(LoopStatistics{});
            last_grants_ = thread_->latestGrants().value_or(RealTimeGrants{});
            thread_->leave();
        } else {
            last_statistics_ = core_->latestClockStatistics();
        }
        giveUp(kHangs);
    } else {
        last_statistics_ = owns_clock_ ? core_->clockStatistics() : thread_->statistics();
        last_grants_ = owns_clock_ ? grants() : thread_->grants();
        core_->end();
        core_->setStalled(false);
        if (was_stalled && hasEnded()) {
            giveUp(kSilent);
        }
    }
    watchdog_.reset();
    thread_.reset();
}

void ServoLoop::giveUp(std::string trouble)
{
    trouble_ = std::move(trouble);
    core_->setStalled(true);
    core_->giveUp();
}

Status ServoLoop::status() const
{
    const std::string why = !trouble_.empty()           ? trouble_
                            : isStalled() && hasEnded() ? owns_clock_ ? kSilent : kHangs
                                                        : std::string();
    if (why.empty()) {
        return Done{};
    }
    return Error{ErrorCode::Unreadable, fmt::format("{}: {}", device().name, why)};
}

std::string ServoLoop::trouble() const
{
    if (!trouble_.empty()) {
        return trouble_;
    }
    if (isStalled()) { // its driver may also hang in this call
        return hasEnded() ? owns_clock_ ? kSilent : kHangs : std::string();
    }
    return core_->device().trouble();
}

LoopStatistics ServoLoop::statistics() const
{
    if (!is_running_) {
        return last_statistics_;
    }
    return owns_clock_ ? core_->latestClockStatistics()
                       : thread_->latestStatistics().value_or(LoopStatistics{});
}

RealTimeGrants ServoLoop::grants() const
{
    if (owns_clock_) {
        return {.scheduling_refusal = "the device's own thread is used",
                .locking_refusal = "the device's own thread is used"};
    }
    return is_running_ ? thread_->latestGrants().value_or(RealTimeGrants{}) : last_grants_;
}

} // namespace marsview
