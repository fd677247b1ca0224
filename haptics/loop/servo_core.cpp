#include "haptics/loop/servo_core.h"

#include "haptics/loop/rt_scope.h"
#include "haptics/loop/thread_faults.h"

#include <utility>

namespace marsview {
namespace {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

double secondsBetween(LoopTime begin, LoopTime end) noexcept
{
    return std::chrono::duration<double>(end - begin).count();
}

} // namespace

ServoCore::ServoCore(std::unique_ptr<HapticDevice> device, const ServoCoreOptions& options)
    : device_(std::move(device))
    , options_(options)
    , flight_(options.flight_ticks)
{}

std::vector<MemoryRange> ServoCore::memory() const
{
    return {{this, sizeof *this},
            flight_.memory(),
            {records_.data(), records_.bytes()},
            {ground_records_.data(), ground_records_.bytes()}};
}

void ServoCore::begin()
{
    const WorkspaceFrame frame = tick_.frame;
    const WorkspaceFrame seen_frame = tick_.seen_frame;
    const std::uint64_t frame_number = tick_.frame_number;
    const bool has_frame = tick_.has_frame;
    const double heat_n2 = cooledHeat(options_.tick.limits, tick_.safety.heat_n2,
                                      secondsBetween(rested_at_, steady_clock::now()));
    tick_ = {};
    tick_.safety.heat_n2 = heat_n2;
    tick_.frame = frame;
    tick_.seen_frame = seen_frame;
    tick_.frame_number = frame_number;
    tick_.has_frame = has_frame;
    counts_ = {};
    ticks_ = 0;
    read_at_ = {};
    wrote_at_ = {};
    was_too_long_ = false;
    clock_statistics_ = {};
    clock_last_ = {};
    is_ending_.store(false, std::memory_order_relaxed);
    is_stalled_.store(false, std::memory_order_relaxed);
    is_brought_to_rest_.store(false, std::memory_order_relaxed);
    beats_.store(0, std::memory_order_release);
}

void ServoCore::end()
{
    rested_at_ = steady_clock::now();
    if (const auto& map = settings_.front().map) {
        for (const ServoTiles& tiles : map->tiles) {
            tiles.terrain->leave();
        }
    }
}

void ServoCore::bringToRest() noexcept
{
    if (!takeDevice()) {
        return;
    }
    if (device_->write({}) == DeviceStatus::Fine) {
        is_brought_to_rest_.store(true, std::memory_order_release);
    }
    leaveDevice();
}

void ServoCore::giveUp() noexcept
{
    askToEnd();
    is_given_up_.store(true, std::memory_order_release);
    has_ended_.store(true, std::memory_order_release);
}

LoopState ServoCore::state() const noexcept
{
    LoopState state = state_.read();
    if (isStalled()) {
        state.is_stalled = true;
        state.reason = ForceOffReason::LoopStalled;
        if (is_brought_to_rest_.load(std::memory_order_acquire)) {
            state.force_n = {};
        }
    }
    return state;
}

void ServoCore::deviceTick(void* self, LoopTime now) noexcept
{
    auto& core = *static_cast<ServoCore*>(self);
    const nanoseconds period = core.options_.period;
    // The device's clock determines the deadlines: a tick is due one period after the last.
    const LoopTime due = core.clock_last_ == LoopTime{} ? now : core.clock_last_ + period;
    core.clock_last_ = now;
    const ThreadFaults before = faultsOfThisThread();
    core.turn(now, now - due > period);
    const ThreadFaults after = faultsOfThisThread();
    if (core.ticks_ == core.options_.uncounted_turns) {
        core.clock_statistics_ = {};
    }
    core.clock_statistics_.minor_faults += after.minor - before.minor;
    core.clock_statistics_.major_faults += after.major - before.major;
    core.clock_statistics_.add({.deadline = due, .begin = now, .end = steady_clock::now()}, period);
    constexpr std::uint64_t kPublishEvery = 128;
    if (core.ticks_ % kPublishEvery == 0) {
        core.clock_published_.write(core.clock_statistics_);
    }
}

// With the position to which the hand moves if it keeps its velocity.
void ServoCore::prepareTurn() noexcept
{
    if (read_at_ == LoopTime{} || settings_.front().map == nullptr) {
        return;
    }
    const RtScope scope;
    const LoopTime now = steady_clock::now();
    const double period_s = std::chrono::duration<double>(options_.period).count();
    TickInput input{.settings = &settings_.front(),
                    .device = &device_->capabilities(),
                    .sample = sample_,
                    .now = now,
                    .since_write_s = period_s};
    input.sample.position = sample_.position + shift_m_;
    input.sample.time = now;
    rehearse(options_.tick, input, tick_, period_s);
    // What publish() writes.
    state_.prefetch();
    flight_.prefetchNext();
    records_.prefetchNext();
}

LoopOutcome ServoCore::turn(LoopTime begin, bool has_missed_deadline) noexcept
{
    const RtScope scope;
    beats_.fetch_add(1, std::memory_order_release);
    setStalled(false);
    const LoopOutcome outcome = turnInside(begin, has_missed_deadline);
    was_too_long_ = steady_clock::now() - begin > options_.period;
    beats_.fetch_add(1, std::memory_order_release);
    return outcome;
}

LoopOutcome ServoCore::turnInside(LoopTime begin, bool has_missed_deadline) noexcept
{
    if (ticks_ == options_.uncounted_turns) {
        counts_ = {};
    }
    if (!takeDevice()) {
        return LoopOutcome::Continue; // the watchdog is bringing it to rest
    }
    const WorkspacePoint before = sample_.position;
    const DeviceStatus status = device_->read(sample_);
    leaveDevice();
    shift_m_ = sample_.position - before;
    if (is_abandoned_.load(std::memory_order_acquire)) {
        writeForce({});
        return LoopOutcome::Stop;
    }
    if (settings_.take() && settings_.front().strokes) {
        device_->strokeWithin(*settings_.front().strokes);
    }
    if (is_brought_to_rest_.exchange(false, std::memory_order_acq_rel)) {
        forgetForce();
    }
    const LoopTime now = steady_clock::now();
    const double dt_s = read_at_ == LoopTime{} ? 0.0 : secondsBetween(read_at_, now);
    read_at_ = now;
    RecordedTick recorded;
    const bool is_recorded = device_->recordedTick(recorded);
    TickInput input{.settings = &settings_.front(),
                    .device = &device_->capabilities(),
                    .status = status,
                    .sample = sample_,
                    .recorded = is_recorded ? &recorded : nullptr,
                    .now = now,
                    .has_missed_deadline = has_missed_deadline || was_too_long_,
                    .since_write_s =
                        wrote_at_ == LoopTime{} ? 0.0 : secondsBetween(wrote_at_, now)};
    const bool is_ending = is_ending_.load(std::memory_order_acquire);
    if (is_ending && status == DeviceStatus::Fine) {
        input.status = DeviceStatus::Unready; // turns the force off in any case
    }
    const StepResult result = step(options_.tick, input, tick_, dt_s);
    const DeviceStatus written = writeForce(result.force_n);

    counts_.read_errors += status == DeviceStatus::Fine ? 0U : 1U;
    is_finished_ = status == DeviceStatus::Finished || status == DeviceStatus::Lost ||
                   written == DeviceStatus::Lost;
    ++ticks_;
    const bool is_over = is_finished_ || (options_.ticks_max != 0 && ticks_ >= options_.ticks_max);
    const bool is_at_rest = result.force_n == Vec3{} || written == DeviceStatus::Lost;
    StepResult published = result;
    published.force_n = recorded.force_n.value_or(result.force_n);
    published.is_force_recorded = recorded.force_n.has_value();
    publish(published, secondsBetween(begin, steady_clock::now()));
    if ((is_over || is_ending) && is_at_rest) {
        if (is_over) {
            has_ended_.store(true, std::memory_order_release);
        }
        return LoopOutcome::Stop;
    }
    if (is_over) {
        askToEnd();
    }
    return LoopOutcome::Continue;
}

// The motors have no force: the next force starts from zero.
void ServoCore::forgetForce() noexcept
{
    tick_.safety = {.heat_n2 = tick_.safety.heat_n2};
    noteWritten(tick_.passivity, {});
}

DeviceStatus ServoCore::writeForce(const Vec3& force_n) noexcept
{
    if (!takeDevice()) {
        return DeviceStatus::Unready; // it is being brought to rest
    }
    DeviceStatus written = DeviceStatus::Unready;
    if (!is_brought_to_rest_.load(std::memory_order_acquire)) {
        written = device_->write(force_n);
        if (is_abandoned_.load(std::memory_order_acquire)) {
            device_->write({}); // the loop was abandoned during the call
        }
        wrote_at_ = steady_clock::now();
    }
    leaveDevice();
    if (written != DeviceStatus::Fine) {
        forgetForce();
    }
    return written;
}

void ServoCore::publish(const StepResult& result, double tick_s) noexcept
{
    ++counts_.ticks;
    counts_.in_contact += result.contact.is_in_contact && result.goals.count > 0 ? 1U : 0U;
    counts_.cut_short += result.goals.count > 0 ? result.contact.counters.cut_short : 0U;
    counts_.samples_missed += result.missed_samples;
    counts_.ticks_with_misses += result.missed_samples > 0 ? 1U : 0U;
    counts_.force_off += result.reason != ForceOffReason::None ? 1U : 0U;
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
                  .is_force_recorded = result.is_force_recorded,
                  .is_at_edge = result.is_at_edge,
                  .ground_share = result.ground_share,
                  .stiffness_n_per_m = result.stiffness_n_per_m,
                  .tick_s = tick_s,
                  .frame = tick_.frame,
                  .seen_frame = tick_.seen_frame,
                  .frame_number = tick_.frame_number,
                  .counts = counts_,
                  .is_finished = is_finished_});
    // If no thread reads the events, the oldest are kept.
    if (result.has_changed_mode) {
        events_.put({.kind = LoopEventKind::ModeChanged, .mode = result.mode, .tick = ticks_});
    }
    if (result.has_changed_map) {
        events_.put({.kind = LoopEventKind::MapChanged, .mode = result.mode, .tick = ticks_});
    }
    for (const auto& [has_happened, kind] :
         {std::pair(result.has_pressed_point, LoopEventKind::PointPressed),
          std::pair(result.has_released_point, LoopEventKind::PointReleased)}) {
        if (has_happened) {
            events_.put({.kind = kind,
                         .mode = result.mode,
                         .tick = ticks_,
                         .place = result.contact.is_in_contact || result.is_at_edge
                                      ? result.contact.proxy
                                      : result.goal});
        }
    }
    if (result.reason != last_reason_) {
        last_reason_ = result.reason;
        events_.put({.kind = result.reason == ForceOffReason::None ? LoopEventKind::Holding
                                                                   : LoopEventKind::ForceOff,
                     .mode = result.mode,
                     .reason = result.reason,
                     .tick = ticks_});
    }
}

void ServoCore::record(const StepResult& result, double tick_s) noexcept
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
                      .surface_z_m = result.surface_z_m,
                      .tick_us = static_cast<float>(tick_s * 1e6)};
    if (const auto& map = settings_.front().map; map != nullptr) {
        record.ground = {.serial = map->serial,
                         .map_id = map->map_id,
                         .kind = map->kind,
                         .radius_m = map->radius_m,
                         .exaggeration = map->frame.exaggeration()};
        record.is_on_body = map->surface->body() != nullptr;
    }
    const bool is_kept = takeRecording();
    const bool has_room = !is_kept || recordGround(result.has_ground_changed);
    if (!has_room && result.goals.count == 0) {
        ++counts_.not_recorded;
    }
    if (result.motion) { // together with those of ticks without an update
        motion_ = has_motion_ ? combined(motion_, *result.motion) : *result.motion;
        has_motion_ = true;
    }
    for (std::size_t i = 0; i < result.goals.count; ++i) {
        record.has_motion = has_motion_;
        record.motion = motion_;
        has_motion_ = false;
        record.goal = result.goals.goals[i];
        record.proxy = result.goals.proxies[i];
        record.is_in_contact = result.goals.are_in_contact[i];
        record.ground_records = untaken_ground_count_;
        if (is_kept && has_room && records_.put(record)) {
            untaken_ground_count_ = 0;
        } else if (is_kept) {
            ++counts_.not_recorded;
        }
    }
    flight_.add(record);
}

// Whether updates are recorded. A new recording gets all terrain records.
bool ServoCore::takeRecording() noexcept
{
    const std::uint64_t recording = recording_.load(std::memory_order_relaxed);
    if (recording != told_recording_) {
        told_recording_ = recording;
        untaken_ground_count_ = 0;
        ground_log_.forget();
    }
    return recording != 0;
}

// False if the queue is full.
bool ServoCore::recordGround(bool was_notified) noexcept
{
    const auto& map = settings_.front().map;
    if (map == nullptr) {
        return true;
    }
    const auto count = ground_log_.record(*map, was_notified, ground_records_);
    untaken_ground_count_ += count.value_or(0);
    return count.has_value();
}

} // namespace marsview
