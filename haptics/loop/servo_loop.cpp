#include "haptics/loop/servo_loop.h"

#include "haptics/loop/rt_scope.h"

#include <algorithm>
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

} // namespace

ServoLoop::ServoLoop(std::unique_ptr<HapticDevice> device, const ServoLoopOptions& options)
    : device_(std::move(device))
    , options_(options)
    , tick_options_(options.tick.value_or(tickOptionsFor(device_->capabilities())))
    , owns_clock_(device_->capabilities().owns_clock)
    , records_(std::make_unique<SpscQueue<TickRecord, kRecordsMax>>())
    , flight_(options.flight_ticks)
{
    options_.thread.period = periodOf(device_->capabilities(), options_.thread.period);
}

ServoLoop::~ServoLoop()
{
    stop();
}

void ServoLoop::set(const LoopSettings& settings)
{
    settings_.back() = settings;
    settings_.publish();
    const bool is_needed = settings.map != nullptr && !hasEnded();
    if (is_needed && !is_running_) {
        start();
    } else if (!is_needed && is_running_) {
        stop();
    }
}

void ServoLoop::start()
{
    const WorkspaceFrame frame = tick_.frame;
    const std::uint64_t frame_number = tick_.frame_number;
    const bool has_frame = tick_.has_frame;
    const double heat_n2 =
        cooledHeat(tick_options_.limits, tick_.safety.heat_n2,
                   std::chrono::duration<double>(steady_clock::now() - stopped_).count());
    tick_ = {};
    tick_.safety.heat_n2 = heat_n2;
    tick_.frame = frame;
    tick_.frame_number = frame_number;
    tick_.has_frame = has_frame;
    counts_ = {};
    ticks_ = 0;
    is_ending_.store(false, std::memory_order_relaxed);
    is_running_ = true;
    if (owns_clock_) {
        device_statistics_ = {};
        device_last_ = {};
        device_->startClock(&ServoLoop::deviceTick, this);
        return;
    }
    thread_ = std::make_unique<RealTimeThread>(
        options_.thread, [this, last_deadline = LoopTime{}](const LoopTick& tick) mutable noexcept {
            const LoopTime now = steady_clock::now();
            const nanoseconds period = options_.thread.period;
            // Skipped turns, and one that is later than a whole period.
            const bool has_missed = tick.number > 0 && (tick.deadline - last_deadline > period ||
                                                        now - tick.deadline > period);
            last_deadline = tick.deadline;
            return turn(now, tick.dt_s, has_missed);
        });
}

void ServoLoop::stop()
{
    if (!is_running_) {
        return;
    }
    is_ending_.store(true, std::memory_order_release);
    if (owns_clock_) {
        // Its thread ends when the vendor's does; the force fades meanwhile.
        constexpr int kWaitsMax = 100;
        for (int i = 0; i < kWaitsMax && !hasEnded() && !(state_.read().force_n == Vec3{}); ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        device_->stopClock();
        last_statistics_ = device_statistics_;
    } else {
        thread_->join();
        last_statistics_ = thread_->statistics();
        last_grants_ = thread_->grants();
        thread_.reset();
    }
    device_->write({});
    stopped_ = steady_clock::now();
    is_running_ = false;
    if (const auto& map = settings_.front().map; map && map->terrain) {
        map->terrain->leave();
    }
}

LoopStatistics ServoLoop::statistics() const
{
    if (!is_running_) {
        return last_statistics_;
    }
    return owns_clock_ ? device_published_.read()
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

void ServoLoop::deviceTick(void* self, steady_clock::time_point now) noexcept
{
    auto& loop = *static_cast<ServoLoop*>(self);
    const nanoseconds period = loop.options_.thread.period;
    const bool is_first = loop.device_last_ == LoopTime{};
    const double dt_s =
        is_first ? 0.0 : std::chrono::duration<double>(now - loop.device_last_).count();
    if (is_first) {
        loop.device_deadline_ = now;
    }
    const bool has_missed = now - loop.device_deadline_ > period;
    loop.device_last_ = now;
    loop.turn(now, dt_s, has_missed);
    if (loop.ticks_ == loop.options_.thread.uncounted_turns) {
        loop.device_statistics_ = {};
    }
    loop.device_statistics_.add(
        {.deadline = loop.device_deadline_, .begin = now, .end = steady_clock::now()}, period);
    // The vendor's clock is the clock: the next tick is due a period after this one.
    loop.device_deadline_ = now + period;
    constexpr std::uint64_t kPublishEvery = 128;
    if (loop.ticks_ % kPublishEvery == 0) {
        loop.device_published_.write(loop.device_statistics_);
    }
}

LoopOutcome
ServoLoop::turn(steady_clock::time_point now, double dt_s, bool has_missed_deadline) noexcept
{
    const RtScope scope;
    if (ticks_ == options_.thread.uncounted_turns) {
        counts_ = {};
    }
    settings_.take();
    const DeviceStatus status = device_->read(sample_);
    TracePoint goal;
    const bool is_recorded = device_->recordedGoal(goal);
    TickInput input{.settings = &settings_.front(),
                    .device = &device_->capabilities(),
                    .status = status,
                    .sample = sample_,
                    .recorded_goal = is_recorded ? &goal : nullptr,
                    .now = steady_clock::now(),
                    .has_missed_deadline = has_missed_deadline};
    const bool is_ending = is_ending_.load(std::memory_order_acquire);
    if (is_ending && status == DeviceStatus::Fine) {
        input.status = DeviceStatus::Unready; // lets go, whatever else is the case
    }
    const StepResult result = step(tick_options_, input, tick_, dt_s);
    const DeviceStatus written = device_->write(result.force_n);

    counts_.read_errors += status == DeviceStatus::Fine ? 0U : 1U;
    is_finished_ = status == DeviceStatus::Finished || status == DeviceStatus::Lost ||
                   written == DeviceStatus::Lost;
    const double tick_s = std::chrono::duration<double>(steady_clock::now() - now).count();
    ++ticks_;
    const bool is_over = is_finished_ || (options_.ticks_max != 0 && ticks_ >= options_.ticks_max);
    const bool is_at_rest = result.force_n == Vec3{} || written == DeviceStatus::Lost;
    publish(result, tick_s);
    if ((is_over || is_ending) && is_at_rest) {
        if (is_over) {
            has_ended_.store(true, std::memory_order_release);
        }
        return LoopOutcome::Stop;
    }
    if (is_over) {
        is_ending_.store(true, std::memory_order_release);
    }
    return LoopOutcome::GoOn;
}

void ServoLoop::publish(const StepResult& result, double tick_s) noexcept
{
    ++counts_.ticks;
    counts_.in_contact += result.contact.is_in_contact && result.goals.count > 0 ? 1U : 0U;
    counts_.cut_short += result.goals.count > 0 ? result.contact.counters.cut_short : 0U;
    counts_.samples_missed += result.missed_samples;
    counts_.ticks_with_misses += result.missed_samples > 0 ? 1U : 0U;
    counts_.let_go += result.reason != LetGoReason::None ? 1U : 0U;
    counts_.damped += result.damping_n_s_per_m > 0.0 ? 1U : 0U;
    record(result, tick_s);
    state_.write({.tick = ticks_,
                  .time_ns = steady_clock::now().time_since_epoch() / nanoseconds(1),
                  .hand = result.hand,
                  .goal = result.goal,
                  .contact = result.contact,
                  .mode = result.mode,
                  .reason = result.reason,
                  .force_n = result.force_n,
                  .ground_share = result.ground_share,
                  .stiffness_n_per_m = result.stiffness_n_per_m,
                  .tick_s = tick_s,
                  .frame = tick_.frame,
                  .frame_number = tick_.frame_number,
                  .counts = counts_,
                  .is_finished = is_finished_});
    // A queue that nobody empties keeps the oldest.
    if (result.has_changed_mode) {
        events_.put({.kind = LoopEventKind::ModeChanged, .mode = result.mode, .tick = ticks_});
    }
    if (result.has_changed_map) {
        events_.put({.kind = LoopEventKind::MapChanged, .mode = result.mode, .tick = ticks_});
    }
    if (result.reason != last_reason_) {
        last_reason_ = result.reason;
        events_.put({.kind = result.reason == LetGoReason::None ? LoopEventKind::Holding
                                                                : LoopEventKind::LetGo,
                     .mode = result.mode,
                     .reason = result.reason,
                     .tick = ticks_});
    }
}

void ServoLoop::record(const StepResult& result, double tick_s) noexcept
{
    TickRecord record{.tick = ticks_,
                      .time_ns = steady_clock::now().time_since_epoch() / nanoseconds(1),
                      .proxy = result.proxy,
                      .force_n = result.force_n,
                      .hand = result.hand,
                      .mode = result.mode,
                      .reason = result.reason,
                      .is_in_contact = result.contact.is_in_contact,
                      .has_goal = result.goals.count > 0,
                      .tick_us = static_cast<float>(tick_s * 1e6)};
    if (const auto& map = settings_.front().map; map != nullptr) {
        record.ground = {.serial = map->serial,
                         .map_id = map->map_id,
                         .kind = map->kind,
                         .radius_m = map->radius_m,
                         .exaggeration = map->frame.exaggeration()};
    }
    const bool is_kept = keeps_records_.load(std::memory_order_relaxed);
    for (std::size_t i = 0; i < result.goals.count; ++i) {
        record.goal = result.goals.goals[i];
        record.proxy = result.goals.proxies[i];
        record.is_in_contact = result.goals.are_in_contact[i];
        if (is_kept && !records_->put(record)) {
            ++counts_.not_recorded;
        }
    }
    flight_.add(record);
}

} // namespace marsview
