#include "haptics/device/checked_device.h"

#include "core/base/check.h"
#include "haptics/device/time_between.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

// A hand moves a stylus at up to 5 m/s. In addition, encoders may skip by 20 mm when a device is
// knocked.
constexpr double kSpeedMPerSMax = 20.0;
constexpr double kStepMMax = 0.02;
// After a pause without samples, any position within reach is plausible.
constexpr double kPauseSMax = 0.1;
// A bad sample costs four good ones; three bad ones in a row cross the limit.
constexpr int kDoubtPerFault = 4;
constexpr int kDoubtMax = 11;

bool isInside(const WorkspaceBox& box, const WorkspacePoint& p) noexcept
{
    return p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y &&
           p.z >= box.low.z && p.z <= box.high.z;
}

} // namespace

CheckedDevice::CheckedDevice(std::unique_ptr<HapticDevice> device)
    : device_(std::move(device))
{
    MARSVIEW_CHECK(device_ != nullptr);
    const WorkspaceBox& box = device_->capabilities().workspace;
    const Vec3 size = box.high - box.low;
    reach_ = {box.low + size * -1.0, box.high + size};
}

const DeviceCapabilities& CheckedDevice::capabilities() const noexcept
{
    return device_->capabilities();
}

CheckedDevice::Fault CheckedDevice::faultOf(const DeviceSample& sample) const noexcept
{
    const WorkspacePoint& p = sample.position;
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) ||
        !std::isfinite(sample.twist_rad) || !isFinite(sample.orientation)) {
        return Fault::NotFinite;
    }
    if (!isUnit(sample.orientation)) {
        return Fault::NotARotation;
    }
    if (!isInside(reach_, p)) {
        return Fault::OutOfReach;
    }
    if (has_last_) {
        const std::chrono::duration<double> between = timeBetween(last_.time, sample.time);
        const double dt_s = std::max(0.0, between.count());
        if (dt_s < kPauseSMax && length(p - last_.position) > kStepMMax + kSpeedMPerSMax * dt_s) {
            return Fault::Jump;
        }
    }
    return Fault::None;
}

DeviceStatus CheckedDevice::read(DeviceSample& sample) noexcept
{
    if (is_dropped_) {
        return DeviceStatus::Lost;
    }
    DeviceSample read = last_;
    const DeviceStatus status = device_->read(read);
    is_withholding_ = false;
    if (status != DeviceStatus::Fine) {
        fault_.store(Fault::None, std::memory_order_relaxed); // the device's own reason applies
        is_dropped_ = status == DeviceStatus::Lost;
        return status;
    }
    const Fault fault = faultOf(read);
    if (fault == Fault::None) {
        doubt_ = std::max(0, doubt_ - 1);
        fault_.store(fault, std::memory_order_relaxed);
        last_ = read;
        has_last_ = true;
        sample = read;
        return DeviceStatus::Fine;
    }
    fault_.store(fault, std::memory_order_relaxed);
    doubt_ += kDoubtPerFault;
    is_dropped_ = doubt_ > kDoubtMax;
    is_withholding_ = true;
    device_->write(Vec3{});
    return is_dropped_ ? DeviceStatus::Lost : DeviceStatus::Unready;
}

DeviceStatus CheckedDevice::write(const Vec3& force_n) noexcept
{
    if (is_dropped_) {
        device_->write(Vec3{});
        return DeviceStatus::Lost;
    }
    if (is_withholding_) {
        device_->write(Vec3{});
        return DeviceStatus::Unready;
    }
    const double force = length(force_n);
    if (!std::isfinite(force)) {
        return device_->write(Vec3{});
    }
    const double force_n_max = device_->capabilities().force_n_peak;
    return device_->write(force > force_n_max ? force_n * (force_n_max / force) : force_n);
}

bool CheckedDevice::startClock(ClockTick tick, void* self) noexcept
{
    return device_->startClock(tick, self);
}

void CheckedDevice::stopClock() noexcept
{
    device_->stopClock();
}

std::string CheckedDevice::trouble() const
{
    switch (fault_.load(std::memory_order_relaxed)) {
    case Fault::None:
        return device_->trouble();
    case Fault::NotFinite:
        return "its samples contain numbers that are not finite";
    case Fault::NotARotation:
        return "its orientations are not unit quaternions";
    case Fault::OutOfReach:
        return "its samples lie far outside the workspace that it states; its units may be wrong";
    case Fault::Jump:
        return "its position jumps faster than a hand can move";
    }
    MARSVIEW_CHECK(false);
}

} // namespace marsview
