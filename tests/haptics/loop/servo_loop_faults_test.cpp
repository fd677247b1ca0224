// The loop with devices that stall, hang, and fail.
#include "haptics/loop/servo_loop.h"
#include "tests/haptics/loop/tick_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <sys/mman.h>
#include <thread>
#include <utility>
#include <vector>

namespace marsview::test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// Once opened, it stays open.
class Gate {
public:
    void open()
    {
        const std::lock_guard lock(mutex_);
        is_open_ = true;
        opened_.notify_all();
    }
    void pass()
    {
        std::unique_lock lock(mutex_);
        opened_.wait(lock, [this] { return is_open_; });
    }

private:
    std::mutex mutex_;
    std::condition_variable opened_;
    bool is_open_ = false;
};

struct Write {
    Clock::time_point time;
    Vec3 force_n;
    bool is_from_tick = true;
};

// The behavior and the records of a device. Outlives the device, because a device that hangs may be
// closed late.
struct Bench {
    // Called in each read, with its number from 0, and in each of the other calls.
    std::function<void(int)> in_read = [](int) {};
    std::function<void(int)> in_write = [](int) {};
    std::function<bool(int)> is_clock_stalled = [](int) { return false; };
    std::function<void()> in_stop_clock = [] {};
    bool starts_clock = true;
    bool owns_clock = false;
    std::atomic<double> height_m{-0.02}; // of the device; the surface is at 0
    std::atomic<int> reads{0};
    std::atomic<bool> is_closed{false};

    std::mutex mutex;
    std::vector<Write> writes;
    Gate gate;

    Vec3 onMotors()
    {
        const std::lock_guard lock(mutex);
        return writes.empty() ? Vec3{} : writes.back().force_n;
    }
};

class BenchDevice final : public HapticDevice {
public:
    explicit BenchDevice(std::shared_ptr<Bench> bench)
        : bench_(std::move(bench))
        , capabilities_(desktopDevice())
    {
        capabilities_.name = "Bench";
        capabilities_.owns_clock = bench_->owns_clock;
        bench_->writes.reserve(100'000);
    }
    ~BenchDevice() override
    {
        endThread();
        bench_->is_closed = true;
    }
    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override
    {
        ticking_ = std::this_thread::get_id();
        bench_->in_read(bench_->reads++);
        sample.position = {0.0, 0.0, bench_->height_m};
        sample.time = Clock::now();
        return DeviceStatus::Fine;
    }
    DeviceStatus write(const Vec3& force_n) noexcept override
    {
        const bool is_from_tick = std::this_thread::get_id() == ticking_;
        bench_->in_write(++writes_); // takes effect on the motors after that
        const std::lock_guard lock(bench_->mutex);
        bench_->writes.push_back({Clock::now(), force_n, is_from_tick});
        return DeviceStatus::Fine;
    }
    bool startClock(ClockTick tick, void* self) noexcept override
    {
        if (!bench_->starts_clock) {
            return false;
        }
        is_stopping_ = false;
        thread_ = std::thread([this, tick, self] {
            for (int i = 0; !is_stopping_; ++i) {
                if (!bench_->is_clock_stalled(i)) {
                    tick(self, Clock::now());
                }
                std::this_thread::sleep_for(1ms);
            }
        });
        return true;
    }
    void stopClock() noexcept override
    {
        bench_->in_stop_clock();
        endThread();
    }
    std::string trouble() const override
    {
        return bench_->starts_clock ? "" : "its emergency stop is pressed";
    }

private:
    void endThread()
    {
        is_stopping_ = true;
        if (thread_.joinable()) {
            thread_.join();
        }
    }

    std::shared_ptr<Bench> bench_;
    DeviceCapabilities capabilities_;
    std::atomic<std::thread::id> ticking_{};
    int writes_ = 0;
    std::atomic<bool> is_stopping_{false};
    std::thread thread_;
};

struct Case {
    std::shared_ptr<Bench> bench = std::make_shared<Bench>();
    LoopSettings settings;

    Case()
    {
        settings.map = servoMap(101, 101, [](auto, auto) { return 0.0; });
        settings.frame = {.place = {0.0, 0.0, 0.0}, .scene_per_meter = 1000.0};
        settings.frame_number = 1;
    }
    std::unique_ptr<ServoLoop> begin(double ramp_s = 0.02)
    {
        ServoLoopOptions options;
        options.thread.locks_memory = false;
        options.thread.uncounted_turns = 0;
        options.tick = tickOptionsFor(desktopDevice());
        options.tick->limits.ramp_s = ramp_s;
        auto loop = std::make_unique<ServoLoop>(std::make_unique<BenchDevice>(bench), options);
        loop->set(settings);
        return loop;
    }
};

template <typename F>
void waitUntil(const F& is_so)
{
    while (!is_so()) {
        std::this_thread::yield();
    }
}

bool isHolding(const ServoLoop& loop)
{
    return loop.state().force_n.z > 3.0;
}

double secondsSince(Clock::time_point begin)
{
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

TEST(ServoLoopFaults, TheForceChangesNoFasterThanItsRateInRealTime)
{
    // Stalls of all lengths inside read and write, after which the device is at another position.
    Case c;
    const auto stall = [bench = c.bench.get()](int call) {
        constexpr std::array kStalls{0us, 300us, 1500us, 4000us, 9000us, 11000us, 25000us};
        if (call % 90 == 89) {
            const auto until =
                Clock::now() + kStalls[static_cast<std::size_t>(call / 90) % kStalls.size()];
            while (Clock::now() < until) {
            }
            bench->height_m = bench->height_m > 0.0 ? -0.02 : 0.003;
        }
    };
    c.bench->in_read = stall;
    c.bench->in_write = [stall](int call) { stall(call + 45); };
    auto loop = c.begin();
    waitUntil([&] { return c.bench->reads > 1500; });
    loop->stop();
    double fastest = 0.0;
    int pushed = 0;
    const std::lock_guard lock(c.bench->mutex);
    const auto& writes = c.bench->writes;
    for (std::size_t i = 1; i < writes.size(); ++i) {
        const double between_s =
            std::chrono::duration<double>(writes[i].time - writes[i - 1].time).count();
        const double before_n = length(writes[i - 1].force_n);
        const double after_n = length(writes[i].force_n);
        const double change_n = length(writes[i].force_n - writes[i - 1].force_n);
        if (!writes[i].is_from_tick) {
            continue; // set to zero by the watchdog
        }
        // Switching the force off is faster.
        const double rate = after_n > before_n ? 500.0 : 2000.0;
        ASSERT_LE(change_n, rate * between_s + 1e-9) << "write " << i << " of " << writes.size();
        fastest = std::max(fastest, change_n / (rate * between_s));
        pushed += after_n > 1.0 ? 1 : 0;
    }
    std::printf("fastest %.3f of the limit, %d of %zu with force\n", fastest, pushed,
                writes.size());
    EXPECT_GT(pushed, 100);
    EXPECT_GT(fastest, 0.5);
}

TEST(ServoLoopFaults, OneLongStallSwitchesTheForceOffAndRampsInAgain)
{
    Case c;
    std::atomic<int> stalled_at{1 << 30};
    c.bench->in_read = [&](int read) {
        if (read == stalled_at) {
            std::this_thread::sleep_for(12ms);
        }
    };
    auto loop = c.begin(0.2);
    waitUntil([&] { return isHolding(*loop); });
    LoopEvent event;
    while (loop->nextEvent(event)) {
    }
    stalled_at = c.bench->reads + 2;
    ForceOffReason reason = ForceOffReason::None;
    waitUntil([&] {
        if (loop->nextEvent(event) && event.kind == LoopEventKind::ForceOff) {
            reason = event.reason;
        }
        return reason != ForceOffReason::None;
    });
    EXPECT_EQ(reason, ForceOffReason::MissedDeadline);
    waitUntil([&] { return isHolding(*loop); });
    loop->stop();
    const std::lock_guard lock(c.bench->mutex);
    bool was_at_rest = false;
    for (const Write& write : c.bench->writes) {
        was_at_rest =
            was_at_rest || (write.force_n == Vec3{} &&
                            &write > &c.bench->writes[static_cast<std::size_t>(stalled_at.load())]);
    }
    EXPECT_TRUE(was_at_rest);
}

TEST(ServoLoopFaults, SlowTicksSwitchTheForceOff)
{
    Case c;
    std::atomic<bool> is_slow{false};
    c.bench->in_read = [&](int) {
        if (is_slow) {
            const auto until = Clock::now() + 1400us;
            while (Clock::now() < until) {
            }
        }
    };
    auto loop = c.begin();
    waitUntil([&] { return isHolding(*loop); });
    is_slow = true;
    waitUntil([&] { return loop->state().reason == ForceOffReason::MissedDeadline; });
    const int reads = c.bench->reads;
    waitUntil([&] { return c.bench->reads > reads + 50; });
    EXPECT_EQ(loop->state().reason, ForceOffReason::MissedDeadline);
    EXPECT_EQ(loop->state().force_n, Vec3{});
    is_slow = false;
    waitUntil([&] { return isHolding(*loop); });
}

TEST(ServoLoopFaults, AClockThatStallsIsBroughtToRestFromOutside)
{
    Case c;
    c.bench->owns_clock = true;
    std::atomic<bool> is_stalled{false};
    c.bench->is_clock_stalled = [&](int) { return is_stalled.load(); };
    auto loop = c.begin();
    waitUntil([&] { return isHolding(*loop); });
    is_stalled = true;
    waitUntil([&] { return c.bench->onMotors() == Vec3{}; });
    waitUntil([&] { return loop->isStalled(); });
    LoopState state = loop->state();
    EXPECT_EQ(state.reason, ForceOffReason::LoopStalled);
    EXPECT_TRUE(state.is_stalled);
    waitUntil([&] { return loop->state().force_n == Vec3{}; });
    // During an emergency stop that no tick processes, the motors are already off.
    c.settings.is_stopped = true;
    loop->set(c.settings);
    EXPECT_EQ(c.bench->onMotors(), Vec3{});
    EXPECT_FALSE(loop->hasEnded());
    EXPECT_TRUE(loop->status());

    // The force returns: from zero, along the ramp.
    c.settings.is_stopped = false;
    loop->set(c.settings);
    is_stalled = false;
    waitUntil([&] { return isHolding(*loop) && !loop->isStalled(); });
    loop->stop();
    EXPECT_TRUE(loop->status());
    const std::lock_guard lock(c.bench->mutex);
    const auto& writes = c.bench->writes;
    int from_outside = 0;
    for (std::size_t i = 1; i < writes.size(); ++i) {
        from_outside += writes[i].is_from_tick ? 0 : 1;
        if (!writes[i].is_from_tick) {
            EXPECT_EQ(writes[i].force_n, Vec3{});
            continue;
        }
        const std::chrono::duration<double> between = writes[i].time - writes[i - 1].time;
        const double change_n = length(writes[i].force_n) - length(writes[i - 1].force_n);
        EXPECT_LE(change_n, 500.0 * between.count() + 1e-9) << "write " << i;
    }
    EXPECT_GE(from_outside, 1);
}

TEST(ServoLoopFaults, AClockThatStallsForGoodEndsTheLoop)
{
    Case c;
    c.bench->owns_clock = true;
    std::atomic<bool> is_stalled{false};
    c.bench->is_clock_stalled = [&](int) { return is_stalled.load(); };
    auto loop = c.begin();
    waitUntil([&] { return isHolding(*loop); });
    is_stalled = true;
    waitUntil([&] { return loop->hasEnded(); });
    EXPECT_EQ(loop->state().reason, ForceOffReason::LoopStalled);
    // Too late to recover.
    const int reads = c.bench->reads;
    is_stalled = false;
    waitUntil([&] { return c.bench->reads > reads + 5; });
    EXPECT_EQ(loop->state().reason, ForceOffReason::LoopStalled);
    loop->stop();
    EXPECT_EQ(c.bench->onMotors(), Vec3{});
    ASSERT_FALSE(loop->status());
    EXPECT_THAT(loop->status().error().message, testing::StartsWith("Bench: it has stopped"));
    EXPECT_NE(loop->trouble(), "");
    loop.reset();
    EXPECT_TRUE(c.bench->is_closed);
}

TEST(ServoLoopFaults, AClockThatNeverTicksEndsTheLoop)
{
    Case c;
    c.bench->owns_clock = true;
    c.bench->is_clock_stalled = [](int) { return true; };
    auto loop = c.begin();
    waitUntil([&] { return loop->hasEnded(); });
    EXPECT_EQ(loop->state().reason, ForceOffReason::LoopStalled);
    loop->stop();
    EXPECT_FALSE(loop->status());
}

TEST(ServoLoopFaults, AClockThatDoesNotStartIsAnError)
{
    Case c;
    c.bench->owns_clock = true;
    c.bench->starts_clock = false;
    auto loop = c.begin();
    EXPECT_TRUE(loop->hasEnded());
    EXPECT_FALSE(loop->isRunning());
    ASSERT_FALSE(loop->status());
    EXPECT_EQ(loop->status().error().message,
              "Bench: its clock could not be started: its emergency stop is pressed");
    EXPECT_EQ(loop->state().reason, ForceOffReason::LoopStalled);
    loop->set(c.settings); // it does not try forever
    EXPECT_FALSE(loop->isRunning());
}

// A driver that never answers: no thread waits for it, and its call may return after the loop is
// gone.
void letItHang(const std::function<void(Bench&, const std::atomic<bool>&)>& arrange)
{
    Case c;
    std::atomic<bool> is_hanging{false};
    arrange(*c.bench, is_hanging);
    auto loop = c.begin();
    waitUntil([&] { return isHolding(*loop); });
    const Vec3 held_n = c.bench->onMotors();
    is_hanging = true;
    if (!c.bench->owns_clock) {
        waitUntil([&] { return loop->isStalled(); });
        EXPECT_EQ(loop->state().reason, ForceOffReason::LoopStalled);
        EXPECT_GT(loop->state().force_n.z, 0.0) << "the force that may still be on the motors";
        EXPECT_GT(held_n.z, 0.0);
        c.settings.is_stopped = true;
        loop->set(c.settings);
    }
    const auto begin = Clock::now();
    loop->stop();
    EXPECT_FALSE(loop->isRunning());
    EXPECT_TRUE(loop->hasEnded());
    ASSERT_FALSE(loop->status());
    EXPECT_THAT(loop->status().error().message, testing::HasSubstr("does not respond"));
    EXPECT_EQ(loop->device().name, "Bench");
    EXPECT_FALSE(loop->flight().records().empty());
    loop->set(c.settings); // the loop must not call the device again
    EXPECT_FALSE(loop->isRunning());
    loop.reset();
    std::printf("left alone after %.2f s\n", secondsSince(begin));
    EXPECT_FALSE(c.bench->is_closed);

    c.bench->gate.open();
    waitUntil([&] { return c.bench->is_closed.load(); });
    EXPECT_EQ(c.bench->onMotors(), Vec3{}) << "the first write";
}

TEST(ServoLoopFaults, ADriverThatHangsInReadIsLeftAlone)
{
    letItHang([](Bench& bench, const std::atomic<bool>& is_hanging) {
        bench.in_read = [&bench, &is_hanging](int) {
            if (is_hanging) {
                bench.gate.pass();
            }
        };
    });
}

TEST(ServoLoopFaults, ADriverThatHangsInWriteIsLeftAlone)
{
    letItHang([](Bench& bench, const std::atomic<bool>& is_hanging) {
        bench.in_write = [&bench, &is_hanging](int) {
            if (is_hanging) {
                bench.gate.pass();
            }
        };
    });
}

TEST(ServoLoopFaults, ADriverThatHangsStoppingItsClockIsLeftAlone)
{
    letItHang([](Bench& bench, const std::atomic<bool>& is_hanging) {
        bench.owns_clock = true;
        bench.in_stop_clock = [&bench, &is_hanging] {
            if (is_hanging) {
                bench.gate.pass();
            }
        };
    });
}

TEST(ServoLoopFaults, CountsPageFaultsOfADeviceThatOwnsTheClock)
{
    Case c;
    c.bench->owns_clock = true;
    // A mapping of its own: the heap may give pages that an earlier test has touched.
    constexpr std::size_t kBytes = std::size_t{16} << 20U;
    constexpr std::size_t kStep = std::size_t{256} << 10U;
    void* memory =
        mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(memory, MAP_FAILED);
    c.bench->in_read = [memory](int read) {
        if (read == 100) {
            for (std::size_t i = 0; i < kBytes; i += kStep) {
                static_cast<volatile char*>(memory)[i] = 1;
            }
        }
    };
    auto loop = c.begin();
    waitUntil([&] { return c.bench->reads > 102; });
    loop->stop();
    EXPECT_GE(loop->statistics().minor_faults + loop->statistics().major_faults, 1U);
    munmap(memory, kBytes);
}

} // namespace
} // namespace marsview::test
