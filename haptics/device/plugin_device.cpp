#include "haptics/device/plugin_device.h"

#include "haptics/device/capability_check.h"
#include "haptics/device/plugin_text.h"
#include "haptics/device/watched_call.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fmt/format.h>

namespace marsview {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kClosePatience{2000};
constexpr std::chrono::milliseconds kMessagePatience{500};
constexpr std::chrono::milliseconds kMessageInterval{250};
constexpr std::size_t kMessageBytes = 400;
constexpr std::uint32_t kSmallNumberMax = 255;

// A status that the interface does not define means a broken device.
DeviceStatus statusOf(std::uint32_t answer) noexcept
{
    switch (answer) {
    case MARSVIEW_FINE:
        return DeviceStatus::Fine;
    case MARSVIEW_UNREADY:
        return DeviceStatus::Unready;
    case MARSVIEW_FINISHED:
        return DeviceStatus::Finished;
    default:
        return DeviceStatus::Lost;
    }
}

std::uint8_t smallNumber(std::uint32_t value) noexcept
{
    return static_cast<std::uint8_t>(std::min(value, kSmallNumberMax));
}

// std::chrono::steady_clock is CLOCK_MONOTONIC. A time slightly in the future was rounded, and
// becomes now. A time farther in the future stays, so that the loop rejects it: replaced by now at
// every read, it would never become stale.
Clock::time_point timeOf(std::int64_t time_ns) noexcept
{
    const Clock::time_point now = Clock::now();
    if (time_ns == 0) {
        return now;
    }
    constexpr std::chrono::milliseconds kRounding{2};
    const Clock::time_point time{std::chrono::nanoseconds(time_ns)};
    return time > now && time - now <= kRounding ? now : time;
}

} // namespace

PluginDevice::PluginDevice(const MarsviewPlugin& table, MarsviewDevice* device)
    : table_(table)
    , device_(device)
{}

PluginDevice::~PluginDevice()
{
    stopClock();
    callWatched(kClosePatience, [close = table_.close, device = device_] {
        close(device);
        return true;
    });
}

std::optional<std::string> PluginDevice::describe(const std::string& plugin_name)
{
    alignas(std::max_align_t) std::array<std::byte, kCapabilitiesBytesMax> room{};
    auto* theirs = reinterpret_cast<MarsviewCapabilities*>(room.data());
    if (table_.capabilities(device_, theirs) != MARSVIEW_FINE) {
        return "does not report its capabilities";
    }
    MarsviewCapabilities c;
    std::memcpy(&c, room.data(), sizeof c);
    const auto point = [](const double(&p)[3]) { // NOLINT(modernize-avoid-c-arrays): C's
        return WorkspacePoint{p[0], p[1], p[2]};
    };
    capabilities_.name.assign(c.name, strnlen(c.name, sizeof c.name));
    if (capabilities_.name.empty()) {
        capabilities_.name = plugin_name;
    }
    capabilities_.workspace = {point(c.workspace_low_m), point(c.workspace_high_m)};
    capabilities_.force_n_peak = c.force_n_peak;
    capabilities_.force_n_continuous = c.force_n_continuous;
    capabilities_.stiffness_n_per_m_max = c.stiffness_n_per_m_max;
    capabilities_.rate_hz = c.rate_hz;
    capabilities_.axes_in = smallNumber(c.axes_in);
    capabilities_.axes_out = smallNumber(c.axes_out);
    capabilities_.buttons = smallNumber(c.buttons);
    capabilities_.owns_clock = (c.flags & MARSVIEW_OWNS_CLOCK) != 0;
    capabilities_.has_presence = (c.flags & MARSVIEW_HAS_PRESENCE) != 0;
    capabilities_.can_set_home = table_.calibrate != nullptr;
    capabilities_.torque_nm_peak = c.torque_nm_peak;
    if (capabilities_.owns_clock && table_.start_clock == nullptr) {
        return "states that it owns the clock but has no function to start it";
    }
    return impossibilityOf(capabilities_);
}

DeviceStatus PluginDevice::read(DeviceSample& sample) noexcept
{
    sample_.fill(std::byte{0});
    const std::uint32_t answer =
        table_.read(device_, reinterpret_cast<MarsviewSample*>(sample_.data()));
    answer_.store(answer, std::memory_order_relaxed);
    const DeviceStatus status = noted(answer);
    if (status != DeviceStatus::Fine) {
        return status;
    }
    MarsviewSample theirs;
    std::memcpy(&theirs, sample_.data(), sizeof theirs);
    sample.position = {theirs.position_m[0], theirs.position_m[1], theirs.position_m[2]};
    sample.twist_rad = theirs.twist_rad;
    const double(&q)[4] = theirs.orientation; // NOLINT(modernize-avoid-c-arrays): C's
    const bool is_measured = q[0] != 0.0 || q[1] != 0.0 || q[2] != 0.0 || q[3] != 0.0;
    sample.orientation = is_measured ? Orientation{q[0], q[1], q[2], q[3]} : Orientation{};
    sample.buttons = theirs.buttons;
    sample.is_held = !capabilities_.has_presence || theirs.is_held != 0;
    sample.time = timeOf(theirs.time_ns);
    return status;
}

DeviceStatus PluginDevice::write(const Vec3& force_n) noexcept
{
    const double force[3] = {force_n.x, force_n.y, force_n.z}; // NOLINT(modernize-avoid-c-arrays)
    const double torque[3] = {};                               // NOLINT(modernize-avoid-c-arrays)
    const std::uint32_t answer = table_.write_wrench != nullptr
                                     ? table_.write_wrench(device_, force, torque)
                                     : table_.write(device_, force);
    if (answer != MARSVIEW_FINE) { // the status of `read` stays known otherwise
        answer_.store(answer, std::memory_order_relaxed);
    }
    return noted(answer);
}

DeviceStatus PluginDevice::noted(std::uint32_t answer) noexcept
{
    if (answer > MARSVIEW_FINISHED) {
        strange_answer_.store(answer, std::memory_order_relaxed);
    }
    return statusOf(answer);
}

std::optional<std::string> PluginDevice::calibrate()
{
    if (table_.calibrate == nullptr) {
        return "cannot be calibrated by \",home\"; its plugin has no function for it";
    }
    const std::uint32_t answer = table_.calibrate(device_);
    if (noted(answer) == DeviceStatus::Fine) {
        return std::nullopt;
    }
    answer_.store(answer, std::memory_order_relaxed);
    const std::string why = message();
    return why.empty() ? "could not be calibrated; its plugin gave no reason" : why;
}

std::string PluginDevice::trouble() const
{
    const std::uint32_t answer = strange_answer_.load(std::memory_order_relaxed);
    if (answer != 0) {
        return fmt::format(
            "its plugin returned {}, an unknown status; report it to the plugin's "
            "makers",
            answer);
    }
    return message();
}

std::string PluginDevice::message() const
{
    const std::uint32_t answer = answer_.load(std::memory_order_relaxed);
    if (table_.message == nullptr || (answer != MARSVIEW_UNREADY && answer != MARSVIEW_LOST)) {
        return {};
    }
    const std::lock_guard lock(message_mutex_);
    const Clock::time_point now = Clock::now();
    if (is_mute_ || (answer == message_answer_ && now - message_time_ < kMessageInterval)) {
        return message_;
    }
    const auto said = callWatched(kMessagePatience, [ask = table_.message, device = device_] {
        std::array<char, kMessageBytes> text{};
        ask(device, text.data(), text.size());
        return shownPluginText(text.data(), text.size());
    });
    is_mute_ = !said.has_value();
    message_ = said.value_or(
        "did not return from being asked why it is not ready; report it to "
        "the plugin's makers");
    message_answer_ = answer;
    message_time_ = now;
    return message_;
}

bool PluginDevice::startClock(ClockTick tick, void* self) noexcept
{
    if (!capabilities_.owns_clock) {
        return false;
    }
    tick_ = tick;
    tick_self_ = self;
    const auto forward = [](void* device) noexcept {
        const auto* me = static_cast<const PluginDevice*>(device);
        me->tick_(me->tick_self_, Clock::now());
    };
    if (table_.start_clock(device_, forward, this) != MARSVIEW_FINE) {
        tick_ = nullptr;
        return false;
    }
    return true;
}

void PluginDevice::stopClock() noexcept
{
    if (tick_ != nullptr) {
        table_.stop_clock(device_);
        tick_ = nullptr;
    }
}

} // namespace marsview
