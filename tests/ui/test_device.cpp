#include "tests/ui/test_device.h"

#include "haptics/drivers/replay_driver.h"
#include "haptics/drivers/simulated/sim_driver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

namespace marsview {
namespace {

class HandDevice final : public HapticDevice {
public:
    explicit HandDevice(std::shared_ptr<TestHand> hand)
        : hand_(std::move(hand))
    {
        capabilities_.name = "Test hand";
        capabilities_.workspace = {{-0.08, -0.06, -0.06}, {0.08, 0.06, 0.06}};
        capabilities_.force_n_peak = 3.0;
        capabilities_.force_n_continuous = 3.0;
        capabilities_.stiffness_n_per_m_max = 400.0;
        ++hand_->open_count;
    }
    ~HandDevice() override { --hand_->open_count; }

    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override
    {
        if (hand_->is_lost) {
            return DeviceStatus::Lost;
        }
        if (const std::unique_lock lock(hand_->mutex, std::try_to_lock); lock.owns_lock()) {
            wanted_ = hand_->position;
        }
        // As a hand moves, 0.2 m/s: one that jumps slips (see PanOptions::grip_rate_n_per_s_max).
        // While the machine does other work, the hand waits: a tick lasts at most 10 ms for the
        // loop.
        constexpr double kSpeedMPerS = 0.2;
        constexpr std::chrono::duration<double> kPauseMax(0.01);
        const auto now = std::chrono::steady_clock::now();
        const double step_m =
            kSpeedMPerS *
            std::min<std::chrono::duration<double>>(now - read_at_, kPauseMax).count();
        read_at_ = now;
        const Vec3 way = wanted_ - at_;
        const double far_m = length(way);
        at_ = far_m > step_m ? at_ + way * (step_m / far_m) : wanted_;
        sample = {.position = at_, .buttons = hand_->buttons, .time = now};
        return DeviceStatus::Fine;
    }
    DeviceStatus write(const Vec3& force_n) noexcept override
    {
        hand_->force_n = length(force_n);
        hand_->force_n_min = std::min(hand_->force_n_min.load(), length(force_n));
        return DeviceStatus::Fine;
    }
    std::string trouble() const override { return hand_->is_lost ? "the plug was pulled" : ""; }

private:
    std::shared_ptr<TestHand> hand_;
    DeviceCapabilities capabilities_;
    WorkspacePoint wanted_{};
    WorkspacePoint at_{};
    std::chrono::steady_clock::time_point read_at_ = std::chrono::steady_clock::now();
};

class HandDriver final : public DeviceDriver {
public:
    explicit HandDriver(std::shared_ptr<TestHand> hand)
        : hand_(std::move(hand))
    {}
    std::string_view scheme() const noexcept override { return "hand"; }
    std::vector<FoundDevice> find() override
    {
        return hand_->is_there ? std::vector<FoundDevice>{{"hand:", "Test hand", ""}}
                               : std::vector<FoundDevice>{};
    }
    Result<std::unique_ptr<HapticDevice>> open(std::string_view /*address*/) override
    {
        while (hand_->is_held_up) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        if (!hand_->is_there) {
            return Error{ErrorCode::NotFound, "hand:: is not there"};
        }
        return std::unique_ptr<HapticDevice>(new HandDevice(hand_));
    }

private:
    std::shared_ptr<TestHand> hand_;
};

class GoneDriver final : public DeviceDriver {
public:
    std::string_view scheme() const noexcept override { return "gone"; }
    std::vector<FoundDevice> find() override
    {
        return {{"gone:", "Arm", "may not be opened by this user; install the udev rules"}};
    }
    Result<std::unique_ptr<HapticDevice>> open(std::string_view address) override
    {
        if (address == "locked") {
            return Error{ErrorCode::Unreadable, "gone:locked: may not be opened by this user"};
        }
        return Error{ErrorCode::NotFound, "gone:: is not there"};
    }
};

} // namespace

DriverMaker testDrivers(const std::shared_ptr<TestHand>& hand)
{
    return [hand] {
        std::vector<std::unique_ptr<DeviceDriver>> drivers;
        drivers.push_back(std::make_unique<HandDriver>(hand));
        drivers.push_back(std::make_unique<GoneDriver>());
        drivers.push_back(makeSimDriver());
        drivers.push_back(makeReplayDriver());
        return drivers;
    };
}

} // namespace marsview
