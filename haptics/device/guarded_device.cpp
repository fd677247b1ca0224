#include "haptics/device/guarded_device.h"

#include <utility>

namespace marsview {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLook{50};

} // namespace

GuardedDevice::GuardedDevice(Options options)
    : device_(std::move(options.device))
    , plugin_(std::move(options.plugin))
    , marker_folder_(std::move(options.marker_folder))
    , idle_(options.idle)
    , lock_(std::move(options.lock))
    , last_trouble_(std::move(options.last_trouble))
    , marker_(std::move(options.marker))
{
    watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

GuardedDevice::~GuardedDevice()
{
    watcher_.request_stop();
    watcher_.join();
    if (last_trouble_) {
        last_trouble_->set(trouble());
    }
    // If it cannot be marked, for example because another program crashed in this plugin, the
    // device is closed without a marker.
    Result<CrashMarker> closing = markPluginCall(marker_folder_, plugin_, PluginCall::Close);
    marker_.reset();
    device_.reset();
}

const DeviceCapabilities& GuardedDevice::capabilities() const noexcept
{
    return device_->capabilities();
}

DeviceStatus GuardedDevice::read(DeviceSample& sample) noexcept
{
    const DeviceStatus status = device_->read(sample);
    status_.store(status, std::memory_order_relaxed);
    reads_.fetch_add(1, std::memory_order_relaxed);
    return status;
}

DeviceStatus GuardedDevice::write(const Vec3& force_n) noexcept
{
    const DeviceStatus status = device_->write(force_n);
    if (status != DeviceStatus::Fine) {
        status_.store(status, std::memory_order_relaxed);
    }
    return status;
}

bool GuardedDevice::recordedTick(RecordedTick& tick) const noexcept
{
    return device_->recordedTick(tick);
}

bool GuardedDevice::startClock(ClockTick tick, void* self) noexcept
{
    {
        const std::lock_guard lock(mutex_);
        mark();
    }
    return device_->startClock(tick, self);
}

void GuardedDevice::stopClock() noexcept
{
    device_->stopClock();
}

std::string GuardedDevice::trouble() const
{
    std::string known = device_->trouble();
    if (!known.empty()) {
        return known;
    }
    switch (status_.load(std::memory_order_relaxed)) {
    case DeviceStatus::Unready:
        return "its plugin reports that it is not ready, without a reason; check whether it needs "
               "calibration and whether its emergency stop is pressed";
    case DeviceStatus::Lost:
        return "its plugin reports that it is disconnected; check its cable and power, then "
               "reconnect";
    case DeviceStatus::Fine:
    case DeviceStatus::Finished:
        break;
    }
    return {};
}

// Requires mutex_.
void GuardedDevice::mark()
{
    if (!is_on_trial_ || marker_) {
        return;
    }
    Result<CrashMarker> marker = markPluginCall(marker_folder_, plugin_, PluginCall::Run);
    if (marker) {
        marker_.emplace(std::move(*marker));
    }
}

void GuardedDevice::watch(const std::stop_token& stop)
{
    std::unique_lock lock(mutex_);
    std::uint64_t reads = 0;
    Clock::time_point read_last = Clock::now();
    while (!stop.stop_requested()) {
        const std::uint64_t now_reads = reads_.load(std::memory_order_relaxed);
        if (now_reads >= kReadsOfTrial) {
            is_on_trial_ = false;
            marker_.reset();
            return;
        }
        if (now_reads != reads) {
            reads = now_reads;
            read_last = Clock::now();
            mark();
        } else if (Clock::now() - read_last >= idle_) {
            marker_.reset();
        }
        wake_.wait_for(lock, stop, kLook, [] { return false; });
    }
}

} // namespace marsview
