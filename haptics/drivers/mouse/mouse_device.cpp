#include "haptics/drivers/mouse/mouse_device.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

// The size of a typical desktop device, so that settings chosen with one feel similar with the
// other.
constexpr WorkspaceBox kWorkspace{{-0.08, -0.06, -0.06}, {0.08, 0.06, 0.06}};
constexpr double kForceN = 3.3;
constexpr double kStiffnessNPerM = 1000.0;
constexpr int kTriesOfReading = 4;

} // namespace

void MouseLink::setPointer(const MousePointer& pointer) noexcept
{
    const WorkspacePoint& p = pointer.position;
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) ||
        !std::isfinite(pointer.twist_rad)) {
        return;
    }
    MousePointer inside = pointer;
    inside.position = {std::clamp(p.x, kWorkspace.low.x, kWorkspace.high.x),
                       std::clamp(p.y, kWorkspace.low.y, kWorkspace.high.y),
                       std::clamp(p.z, kWorkspace.low.z, kWorkspace.high.z)};
    pointer_.write(inside);
}

std::unique_ptr<MouseDevice> MouseDevice::open(std::shared_ptr<MouseLink> link)
{
    if (link->is_open_.exchange(true)) {
        return nullptr;
    }
    return std::unique_ptr<MouseDevice>(new MouseDevice(std::move(link)));
}

MouseDevice::MouseDevice(std::shared_ptr<MouseLink> link)
    : link_(std::move(link))
{
    capabilities_.name = "Mouse";
    capabilities_.workspace = kWorkspace;
    capabilities_.force_n_peak = kForceN;
    capabilities_.force_n_continuous = kForceN;
    capabilities_.stiffness_n_per_m_max = kStiffnessNPerM;
    capabilities_.axes_in = 6;
    capabilities_.has_presence = true;
}

MouseDevice::~MouseDevice()
{
    link_->force_n_.write({});
    link_->is_open_.store(false);
}

const WorkspaceBox& MouseDevice::workspace()
{
    return kWorkspace;
}

DeviceStatus MouseDevice::read(DeviceSample& sample) noexcept
{
    // A window writes once per frame: a reader cannot meet the writer repeatedly.
    for (int i = 0; i < kTriesOfReading; ++i) {
        if (const auto pointer = link_->pointer_.tryRead()) {
            last_ = *pointer;
            break;
        }
    }
    sample.position = last_.position;
    sample.twist_rad = last_.twist_rad;
    sample.buttons = last_.buttons;
    sample.is_held = last_.is_held;
    sample.time = std::chrono::steady_clock::now();
    return DeviceStatus::Fine;
}

DeviceStatus MouseDevice::write(const Vec3& force_n) noexcept
{
    const double force = length(force_n);
    if (!std::isfinite(force)) {
        link_->force_n_.write({});
    } else {
        link_->force_n_.write(force > kForceN ? force_n * (kForceN / force) : force_n);
    }
    return DeviceStatus::Fine;
}

} // namespace marsview
