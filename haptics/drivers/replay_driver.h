// A recording of goals as a device: it plays back one goal per update.
#pragma once

#include "haptics/device/device_driver.h"
#include "haptics/trace/goal_file.h"

#include <atomic>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

enum class ReplayEnd { Finish, BeginAnew };

/// Goals are in map coordinates, so they are returned by recordedTick(); positions stay in the
/// middle of the workspace. It has no force output.
class ReplayDevice final : public HapticDevice {
public:
    explicit ReplayDevice(std::vector<TracePoint> goals, ReplayEnd end = ReplayEnd::Finish);
    /// With the forces, modes and motions of the map that the recording has.
    explicit ReplayDevice(GoalRecording recording, ReplayEnd end = ReplayEnd::Finish);

    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override;
    DeviceStatus write(const Vec3& force_n) noexcept override;
    bool recordedTick(RecordedTick& tick) const noexcept override;
    double playedShare() const noexcept override;

private:
    DeviceCapabilities capabilities_;
    GoalRecording recording_;
    std::size_t next_motion_ = 0; // of the ticking thread
    ReplayEnd end_;
    std::atomic<std::size_t> next_{0}; // written by the ticking thread
};

/// Whether a URI names a recording.
bool isReplay(std::string_view uri) noexcept;
/// The file of "replay:FILE", also with "#body" and "#loop".
std::string replayedFile(std::string_view uri);
/// The same recording for a map on its body.
std::string replayOnBody(std::string_view uri);
bool isReplayOnBody(std::string_view uri);

/// Scheme "replay". The address is the file; append "#body" if its goals are those of the body
/// scene (GoalColumns::Geographic), and "#loop" to restart at its end.
std::unique_ptr<DeviceDriver> makeReplayDriver();

} // namespace marsview
