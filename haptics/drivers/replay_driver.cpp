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

std::string_view withoutLoop(std::string_view address)
{
    return address.ends_with(kLoop) ? address.substr(0, address.size() - kLoop.size()) : address;
}

bool isSomewhere(const TracePoint& goal)
{
    return std::isfinite(goal.x) && std::isfinite(goal.y) && std::isfinite(goal.z);
}

class ReplayDriver final : public DeviceDriver {
public:
    std::string_view scheme() const noexcept override { return "replay"; }
    std::vector<FoundDevice> find() override { return {}; }
    Result<std::unique_ptr<HapticDevice>> open(std::string_view address) override
    {
        const bool is_loop = address.ends_with(kLoop);
        const std::string path(withoutLoop(address));
        if (path.empty() || path == "-") {
            return Error{ErrorCode::Invalid, fmt::format("replay:{}: needs a file of goals, as in "
                                                         "replay:goals.csv",
                                                         path)};
        }
        const Result<std::string> text = readGoalText(path);
        if (!text) {
            return Error{text.error().code, "replay:" + text.error().message};
        }
        Result<std::vector<TracePoint>> goals = readGoals(*text, "replay:" + path);
        if (!goals) {
            return std::move(goals).error();
        }
        const auto nowhere = std::find_if_not(goals->begin(), goals->end(), isSomewhere);
        if (nowhere != goals->end()) {
            return Error{ErrorCode::Invalid,
                         fmt::format("replay:{}: goal {} of {} is at {}, {}, {}, which is not a "
                                     "position; remove it",
                                     path, nowhere - goals->begin() + 1, goals->size(), nowhere->x,
                                     nowhere->y, nowhere->z)};
        }
        if (goals->empty()) {
            return Error{ErrorCode::Invalid,
                         fmt::format("replay:{}: has no goals after its header", path)};
        }
        return std::unique_ptr<HapticDevice>(new ReplayDevice(
            std::move(goals).value(), is_loop ? ReplayEnd::BeginAnew : ReplayEnd::Finish));
    }
};

} // namespace

ReplayDevice::ReplayDevice(std::vector<TracePoint> goals, ReplayEnd end)
    : goals_(std::move(goals))
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
    if (next == goals_.size()) {
        if (end_ == ReplayEnd::Finish || goals_.empty()) {
            return DeviceStatus::Finished;
        }
        next = 0;
    }
    next_.store(next + 1, std::memory_order_relaxed);
    sample = {.time = std::chrono::steady_clock::now()};
    return DeviceStatus::Fine;
}

DeviceStatus ReplayDevice::write(const Vec3& /*force_n*/) noexcept
{
    return DeviceStatus::Fine;
}

bool ReplayDevice::recordedGoal(TracePoint& goal) const noexcept
{
    const std::size_t next = next_.load(std::memory_order_relaxed);
    if (next == 0) {
        return false;
    }
    goal = goals_[next - 1];
    return true;
}

double ReplayDevice::playedShare() const noexcept
{
    return goals_.empty() ? 1.0
                          : static_cast<double>(next_.load(std::memory_order_relaxed)) /
                                static_cast<double>(goals_.size());
}

bool isReplay(std::string_view uri) noexcept
{
    return uri.starts_with(kScheme);
}

std::string replayedFile(std::string_view uri)
{
    return std::string(withoutLoop(isReplay(uri) ? uri.substr(kScheme.size()) : uri));
}

std::unique_ptr<DeviceDriver> makeReplayDriver()
{
    return std::make_unique<ReplayDriver>();
}

} // namespace marsview
