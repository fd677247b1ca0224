#include "haptics/loop/servo_loop.h"
#include "tests/haptics/loop/loop_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <utility>
#include <vector>

namespace marsview::test {
namespace {

using namespace std::chrono_literals;

// The record of a device's writes; a device owned by a loop refers to it.
struct Writes {
    std::vector<Vec3> forces_n;
    std::vector<std::chrono::steady_clock::time_point> times; // the time of each write
    std::atomic<int> reads{0};
};

class WatchedDevice final : public HapticDevice {
public:
    explicit WatchedDevice(Writes& writes)
        : writes_(writes)
        , capabilities_(desktopDevice())
    {
        writes_.forces_n.reserve(1'000'000);
        writes_.times.reserve(1'000'000);
    }
    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override
    {
        ++writes_.reads;
        sample.position = {0.0, 0.0, -0.005};
        sample.time = std::chrono::steady_clock::now();
        return DeviceStatus::Fine;
    }
    DeviceStatus write(const Vec3& force_n) noexcept override
    {
        writes_.forces_n.push_back(force_n);
        writes_.times.push_back(std::chrono::steady_clock::now());
        return DeviceStatus::Fine;
    }

private:
    Writes& writes_;
    DeviceCapabilities capabilities_;
};

TEST(ServoLoop, RunsOnlyWhileThereIsAMapToTouch)
{
    Writes writes;
    ServoLoop loop(std::make_unique<WatchedDevice>(writes), quick(0));
    loop.set({});
    EXPECT_FALSE(loop.isRunning());
    EXPECT_EQ(writes.reads, 0);
    loop.set(settingsFor(servoMap(101, 101, bumps)));
    EXPECT_TRUE(loop.isRunning());
    while (writes.reads < 20) {
        std::this_thread::yield();
    }
    loop.set({});
    EXPECT_FALSE(loop.isRunning());
    const int reads = writes.reads;
    // In the meantime another loop makes twenty turns.
    Writes others;
    ServoLoop other(std::make_unique<WatchedDevice>(others), quick(20));
    other.set(settingsFor(servoMap(101, 101, bumps)));
    waitFor(other);
    EXPECT_EQ(writes.reads, reads);
    EXPECT_EQ(writes.forces_n.back(), Vec3{}); // and leaves the motors off
}

TEST(ServoLoop, FadesOutInsteadOfDroppingTheForce)
{
    Writes writes;
    {
        ServoLoop loop(std::make_unique<WatchedDevice>(writes), quick(0));
        loop.set(settingsFor(servoMap(101, 101, [](auto, auto) { return 0.0; })));
        while (loop.state().force_n.z < 1.0) {
            std::this_thread::yield();
        }
    }
    EXPECT_EQ(writes.forces_n.back(), Vec3{});
    for (std::size_t i = 1; i < writes.forces_n.size(); ++i) {
        const double change_n = length(writes.forces_n[i] - writes.forces_n[i - 1]);
        const std::chrono::duration<double> between = writes.times[i] - writes.times[i - 1];
        EXPECT_LE(change_n, 2000.0 * between.count() + 1e-9) << "write " << i;
    }
}

TEST(ServoLoop, PublishesStateEventsAndStatistics)
{
    ServoLoop loop(simulated(), quick(5000));
    loop.set(settingsFor(servoMap(201, 201, bumps)));
    waitFor(loop);
    loop.stop();
    const LoopState state = loop.state();
    EXPECT_GE(state.tick, 5000U);
    EXPECT_EQ(state.force_n, Vec3{});
    EXPECT_GT(state.counts.in_contact, 500U);
    EXPECT_GE(loop.statistics().tick.count(), 5000U);
    bool has_held = false;
    bool has_changed = false;
    LoopEvent event;
    while (loop.nextEvent(event)) {
        has_held = has_held || event.kind == LoopEventKind::Holding;
        has_changed = has_changed || event.kind == LoopEventKind::ModeChanged;
    }
    EXPECT_TRUE(has_held);
    EXPECT_TRUE(has_changed);
    EXPECT_EQ(loop.flight().records().size(), std::min<std::size_t>(10'000, state.tick));
}

TEST(ServoLoop, ReportsThePointsThatTheButtonSets)
{
    ServoLoop loop(simulated(), quick(5000));
    LoopSettings settings = settingsFor(servoMap(201, 201, bumps));
    settings.is_placing = true;
    loop.set(settings);
    waitFor(loop);
    loop.stop();
    const Heightfield terrain = floatTerrain(201, 201, bumps);
    const SceneFrame frame = settings.map->frame.frame();
    int pressed = 0;
    int released = 0;
    LoopEvent event;
    while (loop.nextEvent(event)) {
        if (event.kind == LoopEventKind::PointReleased) {
            ++released;
        }
        if (event.kind == LoopEventKind::PointPressed) {
            ++pressed;
            const double height_m = terrain.height(frame.toGrid(event.place));
            EXPECT_GE(event.place.z, height_m - 1e-6) << "on the surface, or above it";
        }
        EXPECT_NE(event.mode, StylusMode::Pan);
        EXPECT_NE(event.mode, StylusMode::Zoom);
    }
    // Five thousand ticks of 0.2 ms; the button goes down every 0.3 s.
    EXPECT_EQ(pressed, 3);
    EXPECT_EQ(released, 3);
}

TEST(ServoLoop, TakesOtherSettingsWhileItRuns)
{
    ServoLoop loop(simulated(), quick(0));
    const auto filled = filledTerrain(201, 201, bumps);
    for (int i = 0; i < 60; ++i) {
        LoopSettings settings = settingsFor(makeServoMap(
            meterFrame(201, 201), filled,
            {.kind = kContactModelKinds[static_cast<std::size_t>(i) % kContactModelKinds.size()],
             .contact = {.radius_m = 0.5},
             .map_id = static_cast<std::uint64_t>(i / 10)}));
        settings.frame_number = static_cast<std::uint64_t>(i / 5);
        settings.is_stopped = i % 7 == 0;
        loop.set(settings);
        const std::uint64_t until = loop.state().tick + 20;
        while (loop.state().tick < until) {
            (void)loop.statistics();
            (void)loop.flight().records();
            std::this_thread::yield();
        }
    }
    loop.stop();
    EXPECT_EQ(loop.state().force_n, Vec3{});
}

// A device with its own thread, like the vendors' schedulers.
class ClockDevice final : public HapticDevice {
public:
    ClockDevice()
        : capabilities_(desktopDevice())
    {
        capabilities_.owns_clock = true;
    }
    ~ClockDevice() override { stopClock(); }
    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override
    {
        sample.position = {0.0, 0.0, -0.003};
        sample.time = std::chrono::steady_clock::now();
        return DeviceStatus::Fine;
    }
    DeviceStatus write(const Vec3& /*force_n*/) noexcept override { return DeviceStatus::Fine; }
    bool startClock(ClockTick tick, void* self) noexcept override
    {
        is_stopping_ = false;
        thread_ = std::thread([this, tick, self] {
            while (!is_stopping_) {
                tick(self, std::chrono::steady_clock::now());
                std::this_thread::sleep_for(200us);
            }
        });
        return true;
    }
    void stopClock() noexcept override
    {
        is_stopping_ = true;
        if (thread_.joinable()) {
            thread_.join();
        }
    }

private:
    DeviceCapabilities capabilities_;
    std::atomic<bool> is_stopping_{false};
    std::thread thread_;
};

TEST(ServoLoop, LetsADeviceThatOwnsTheClockCallTheTick)
{
    ServoLoop loop(std::make_unique<ClockDevice>(), quick(0));
    loop.set(settingsFor(servoMap(101, 101, [](auto, auto) { return 0.0; })));
    while (loop.state().force_n.z < 0.5) {
        std::this_thread::yield();
    }
    loop.stop();
    EXPECT_FALSE(loop.isRunning());
    EXPECT_GT(loop.statistics().tick.count(), 10U);
    EXPECT_NE(loop.grants().scheduling_refusal, "");
}

} // namespace
} // namespace marsview::test
