// Loops and simulated hands for tests of the loop and of its recordings.
#pragma once

#include "haptics/drivers/simulated/sim_driver.h"
#include "haptics/loop/servo_loop.h"
#include "tests/haptics/loop/tick_fixture.h"

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <thread>
#include <utility>

namespace marsview::test {

inline double bumps(std::size_t column, std::size_t row)
{
    return 3.0 * std::sin(0.3 * static_cast<double>(column)) +
           2.0 * std::cos(0.2 * static_cast<double>(row));
}

inline LoopSettings settingsFor(std::shared_ptr<ServoMap> map)
{
    LoopSettings settings;
    settings.map = std::move(map);
    settings.frame = {.place = {0.0, 0.0, 0.0}, .scene_per_meter = 1000.0};
    settings.frame_number = 1;
    return settings;
}

inline ServoLoopOptions quick(std::uint64_t ticks)
{
    ServoLoopOptions options;
    options.thread.locks_memory = false;
    options.thread.uncounted_turns = 0;
    options.ticks_max = ticks;
    return options;
}

inline std::unique_ptr<HapticDevice> simulated(double rate_hz = 5000.0)
{
    SimOptions options;
    options.rate_hz = rate_hz;
    options.lift_s = 0.1;
    options.grab_s = 0.3;
    return std::make_unique<SimDevice>(options);
}

inline void waitFor(const ServoLoop& loop)
{
    while (!loop.hasEnded()) {
        std::this_thread::yield();
    }
}

// A hand that moves in circles, always below the surface of bumps().
class BuriedDevice final : public HapticDevice {
public:
    BuriedDevice() { capabilities_.rate_hz = 5000.0; }
    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override
    {
        turn_rad_ += 2e-3;
        sample.position = {0.04 * std::sin(turn_rad_), 0.03 * std::cos(1.7 * turn_rad_), -0.02};
        sample.time = std::chrono::steady_clock::now();
        return DeviceStatus::Fine;
    }
    DeviceStatus write(const Vec3& /*force_n*/) noexcept override { return DeviceStatus::Fine; }

private:
    double turn_rad_ = 0.0;
    DeviceCapabilities capabilities_ = desktopDevice();
};

} // namespace marsview::test
