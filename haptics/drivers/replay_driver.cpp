#include "haptics/drivers/replay_driver.h"

#include "haptics/trace/goal_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace marsview {
namespace {

constexpr std::string_view kScheme = "replay:";
constexpr std::string_view kLoop = "#loop";

constexpr std::string_view kBody = "#body";

struct ReplayAddress {
    std::string_view path;
    GoalColumns columns = GoalColumns::Map;
    ReplayEnd end = ReplayEnd::Finish;
};

ReplayAddress parsed(std::string_view address)
{
    ReplayAddress result{.path = address};
    if (result.path.ends_with(kLoop)) {
        result.path.remove_suffix(kLoop.size());
        result.end = ReplayEnd::BeginAnew;
    }
    if (result.path.ends_with(kBody)) {
        result.path.remove_suffix(kBody.size());
        result.columns = GoalColumns::Geographic;
    }
    return result;
}

bool isSomewhere(const TracePoint& goal)
{
    return std::isfinite(goal.x) && std::isfinite(goal.y) && std::isfinite(goal.z);
}

GoalRecording recordingOf(std::vector<TracePoint> goals)
{
    GoalRecording recording;
    recording.goals = std::move(goals);
    return recording;
}

class ReplayDriver final : public DeviceDriver {
public:
    std::string_view scheme() const noexcept override { return "replay"; }
    std::vector<FoundDevice> find() override { return {}; }
    Status checkAddress(std::string_view address) const override
    {
        const std::string_view path = parsed(address).path;
        if (path.empty() || path == "-") {
            return Error{ErrorCode::Invalid, fmt::format("replay:{}: needs a file of goals, as in "
                                                         "replay:goals.csv",
                                                         path)};
        }
        return Done{};
    }
    Result<std::unique_ptr<HapticDevice>> open(std::string_view address) override
    {
        if (const Status checked = checkAddress(address); !checked) {
            return checked.error();
        }
        const ReplayAddress replay = parsed(address);
        const std::string path(replay.path);
        const Result<std::string> text = readGoalText(path);
        if (!text) {
            return Error{text.error().code, "replay:" + text.error().message};
        }
        Result<GoalRecording> recording =
            readGoalRecording(*text, "replay:" + path, replay.columns);
        if (!recording) {
            return std::move(recording).error();
        }
        const std::vector<TracePoint>& goals = recording->goals;
        const auto nowhere = std::find_if_not(goals.begin(), goals.end(), isSomewhere);
        if (nowhere != goals.end()) {
            return Error{ErrorCode::Invalid,
                         fmt::format("replay:{}: goal {} of {} is at {}, {}, {}, which is not a "
                                     "position; remove it",
                                     path, nowhere - goals.begin() + 1, goals.size(), nowhere->x,
                                     nowhere->y, nowhere->z)};
        }
        if (goals.empty()) {
            return Error{ErrorCode::Invalid,
                         fmt::format("replay:{}: has no goals after its header", path)};
        }
        return std::unique_ptr<HapticDevice>(
            new ReplayDevice(std::move(recording).value(), replay.end));
    }
};

} // namespace

ReplayDevice::ReplayDevice(std::vector<TracePoint> goals, ReplayEnd end)
    : ReplayDevice(recordingOf(std::move(goals)), end)
{}

ReplayDevice::ReplayDevice(GoalRecording recording, ReplayEnd end)
    : recording_(std::move(recording))
    , end_(end)
{
    capabilities_.name = "Replay";
    capabilities_.workspace = {{-0.08, -0.06, -0.06}, {0.08, 0.06, 0.06}};
    capabilities_.buttons = 0;
    capabilities_.axes_out = 0;
}

DeviceStatus ReplayDevice::read(DeviceSample& sample) noexcept
{
    std::size_t next = next_.load(std::memory_order_relaxed);
    if (next == recording_.goals.size()) {
        if (end_ == ReplayEnd::Finish || recording_.goals.empty()) {
            return DeviceStatus::Finished;
        }
        next = 0;
        next_motion_ = 0;
    }
    const auto& motions = recording_.motions;
    while (next_motion_ < motions.size() && motions[next_motion_].goal < next) {
        ++next_motion_;
    }
    next_.store(next + 1, std::memory_order_relaxed);
    sample = {.time = std::chrono::steady_clock::now()};
    return DeviceStatus::Fine;
}

DeviceStatus ReplayDevice::write(const Vec3& /*force_n*/) noexcept
{
    return DeviceStatus::Fine;
}

bool ReplayDevice::recordedTick(RecordedTick& tick) const noexcept
{
    const std::size_t next = next_.load(std::memory_order_relaxed);
    if (next == 0) {
        return false;
    }
    const std::size_t at = next - 1;
    tick = {.goal = recording_.goals[at]};
    if (at < recording_.forces.size()) {
        tick.force_n = recording_.forces[at].force_n;
        tick.mode = recording_.forces[at].mode;
    }
    const auto& motions = recording_.motions;
    if (next_motion_ < motions.size() && motions[next_motion_].goal == at) {
        tick.motion = motions[next_motion_].motion;
    }
    return true;
}

double ReplayDevice::playedShare() const noexcept
{
    return recording_.goals.empty() ? 1.0
                                    : static_cast<double>(next_.load(std::memory_order_relaxed)) /
                                          static_cast<double>(recording_.goals.size());
}

bool isReplay(std::string_view uri) noexcept
{
    return uri.starts_with(kScheme);
}

std::string replayedFile(std::string_view uri)
{
    return std::string(parsed(isReplay(uri) ? uri.substr(kScheme.size()) : uri).path);
}

std::string replayOnBody(std::string_view uri)
{
    const ReplayAddress replay = parsed(uri);
    return fmt::format("{}{}{}", replay.path, kBody,
                       replay.end == ReplayEnd::BeginAnew ? kLoop : std::string_view());
}

bool isReplayOnBody(std::string_view uri)
{
    return parsed(uri).columns == GoalColumns::Geographic;
}

std::unique_ptr<DeviceDriver> makeReplayDriver()
{
    return std::make_unique<ReplayDriver>();
}

} // namespace marsview
