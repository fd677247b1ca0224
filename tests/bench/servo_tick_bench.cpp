// A tick whose data has been evicted from the processor's caches, as by other programs between two
// ticks, without and with a rehearsal before it. Prints the quantiles of the ticks; each tick's
// time is the median of several passes over the same goals, which removes interruptions.
//
// A hand sweeps over hills, 8 cells per tick, pressed into them. A turn is a tick with the calls of
// the device and with what the loop publishes and records.
#include "app/bench/tick_clock.h"
#include "haptics/loop/haptic_tick.h"
#include "haptics/loop/servo_core.h"
#include "tests/haptics/loop/tick_fixture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace marsview::test {
namespace {

constexpr std::size_t kSide = 4096;
constexpr double kDt = 1e-3;
constexpr double kCellsPerTick = 8.0;

double hills(std::size_t column, std::size_t row)
{
    const auto x = static_cast<double>(column);
    const auto y = static_cast<double>(row);
    return 20.0 * std::sin(0.05 * x) + 15.0 * std::cos(0.07 * y) +
           2.0 * std::sin(0.9 * x + 0.7 * y);
}

// More than the caches of a core hold.
class Eviction {
public:
    void run()
    {
        constexpr std::size_t kLine = 64;
        for (std::size_t i = 0; i < memory_.size(); i += kLine) {
            sum_ += ++memory_[i];
        }
    }

private:
    std::vector<unsigned char> memory_ = std::vector<unsigned char>(std::size_t{48} << 20U);
    unsigned sum_ = 0;
};

enum class Preparation : std::uint8_t { Warm, Evicted, EvictedThenPrepared };

Eviction& eviction()
{
    static Eviction memory;
    return memory;
}

// Meters per tick, at this scale.
constexpr double kScenePerMeter = 25000.0;
constexpr double kSpeed = kCellsPerTick / kScenePerMeter;

WorkspacePoint handAt(std::size_t tick)
{
    const double way = kSpeed * static_cast<double>(tick);
    return {0.06 * std::sin(way / 0.06), 0.04 * std::cos(way / 0.09), -0.0005};
}

LoopSettings settingsOver(const std::shared_ptr<const FilledHeightfield>& terrain)
{
    LoopSettings settings;
    settings.map = makeServoMap(meterFrame(kSide, kSide), terrain, {});
    const ScenePoint middle = settings.map->frame.toScene({0.5 * kSide, -0.5 * kSide, 0.0});
    settings.frame = {.place = middle, .scene_per_meter = kScenePerMeter};
    settings.frame_number = 1;
    return settings;
}

const std::shared_ptr<const FilledHeightfield>& terrain()
{
    static const std::shared_ptr<const FilledHeightfield> made = filledTerrain(kSide, kSide, hills);
    return made;
}

std::vector<double> ticks(std::size_t count, Preparation preparation)
{
    static const TickClock clock;
    const DeviceCapabilities device = desktopDevice();
    const TickOptions options = tickOptionsFor(device);
    const LoopSettings settings = settingsOver(terrain());
    TickState state;
    TickInput input;
    input.settings = &settings;
    input.device = &device;
    std::vector<double> times_us;
    for (std::size_t i = 0; i < count; ++i) {
        input.now += std::chrono::milliseconds(1);
        input.sample.position = handAt(i);
        input.sample.time = input.now;
        if (preparation != Preparation::Warm) {
            eviction().run();
        }
        if (preparation == Preparation::EvictedThenPrepared) {
            rehearse(options, input, state, kDt);
        }
        const std::uint64_t begin = TickClock::now();
        step(options, input, state, kDt);
        times_us.push_back(clock.nanoseconds(TickClock::now() - begin) * 1e-3);
    }
    return times_us;
}

class SweepingDevice final : public HapticDevice {
public:
    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override
    {
        sample.position = handAt(tick_++);
        sample.time = std::chrono::steady_clock::now();
        return DeviceStatus::Fine;
    }
    DeviceStatus write(const Vec3& /*force_n*/) noexcept override { return DeviceStatus::Fine; }

private:
    std::size_t tick_ = 0;
    DeviceCapabilities capabilities_ = desktopDevice();
};

std::vector<double> turns(std::size_t count, Preparation preparation)
{
    static const TickClock clock;
    ServoCore core(std::make_unique<SweepingDevice>(), {.tick = tickOptionsFor(desktopDevice())});
    core.settings().back() = settingsOver(terrain());
    core.settings().publish();
    core.keepRecords(true);
    core.begin();
    std::vector<double> times_us;
    for (std::size_t i = 0; i < count; ++i) {
        if (preparation != Preparation::Warm) {
            eviction().run();
        }
        if (preparation == Preparation::EvictedThenPrepared) {
            core.prepareTurn();
        }
        const std::uint64_t begin = TickClock::now();
        core.turn(std::chrono::steady_clock::now(), false);
        times_us.push_back(clock.nanoseconds(TickClock::now() - begin) * 1e-3);
    }
    core.end();
    return times_us;
}

using Pass = std::vector<double> (*)(std::size_t count, Preparation preparation);

void measure(const char* name, Pass pass, std::size_t count, std::size_t passes, Preparation how)
{
    std::vector<std::vector<double>> all;
    for (std::size_t i = 0; i < passes; ++i) {
        all.push_back(pass(count, how));
    }
    std::vector<double> medians;
    for (std::size_t t = 0; t < count; ++t) {
        std::vector<double> times;
        for (const std::vector<double>& one : all) {
            times.push_back(one[t]);
        }
        std::sort(times.begin(), times.end());
        medians.push_back(times[times.size() / 2]);
    }
    std::sort(medians.begin(), medians.end());
    const auto quantile = [&](double q) {
        return medians[static_cast<std::size_t>(q * static_cast<double>(medians.size() - 1))];
    };
    std::printf("%-40s p50 %6.2f  p99 %6.2f  p99.9 %6.2f us\n", name, quantile(0.5), quantile(0.99),
                quantile(0.999));
}

} // namespace
} // namespace marsview::test

// Like the other benchmarks, briefly with --benchmark_min_time=0.001.
int main(int argc, char** argv)
{
    const bool is_brief = argc > 1 && std::string_view(argv[1]).starts_with("--benchmark_min_time");
    const std::size_t count = is_brief ? 20 : 1500;
    const std::size_t passes = is_brief ? 1 : 5;
    using namespace marsview::test;
    for (const auto& [what, pass] : {std::pair("tick", &ticks), std::pair("turn", &turns)}) {
        std::printf("%s\n", what);
        measure("  caches warm", pass, count, passes, Preparation::Warm);
        measure("  caches evicted", pass, count, passes, Preparation::Evicted);
        measure("  caches evicted, then prepared", pass, count, passes,
                Preparation::EvictedThenPrepared);
    }
    return 0;
}
