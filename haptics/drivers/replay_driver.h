// A recording of goals as a device: it plays back one goal per update.
#pragma once

#include "core/contact/goal_frame.h"
#include "haptics/device/device_driver.h"

#include <atomic>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

enum class ReplayEnd { Finish, BeginAnew };

/// Goals are in map coordinates, so they are returned by recordedGoal(); positions stay in the
/// middle of the workspace. It has no force output.
class ReplayDevice final : public HapticDevice {
public:
    explicit ReplayDevice(std::vector<TracePoint> goals, ReplayEnd end = ReplayEnd::Finish);

    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override;
    DeviceStatus write(const Vec3& force_n) noexcept override;
    bool recordedGoal(TracePoint& goal) const noexcept override;
    double playedShare() const noexcept override;

private:
    DeviceCapabilities capabilities_;
    std::vector<TracePoint> goals_;
    ReplayEnd end_;
    std::atomic<std::size_t> next_{0}; // written by the ticking thread
};

/// Whether a URI names a recording.
bool isReplay(std::string_view uri) noexcept;
/// The file of "replay:FILE" or "replay:FILE#loop".
std::string replayedFile(std::string_view uri);

/// Scheme "replay". The address is the file; append "#loop" to restart at its end.
std::unique_ptr<DeviceDriver> makeReplayDriver();

} // namespace marsview
