// A tick whose data has been evicted from the processor's caches, as by other programs between two
// ticks, without and with a rehearsal before it. Prints the quantiles of the ticks; each tick's
// time is the median of several passes over the same goals, which removes interruptions.
//
// A hand sweeps over hills, 8 cells per tick, pressed into them.
#include "app/bench/tick_clock.h"
#include "haptics/loop/haptic_tick.h"
#include "tests/haptics/loop/tick_fixture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <string_view>
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

std::vector<double> pass(std::size_t ticks, bool is_rehearsed, bool is_evicted)
{
    static const std::shared_ptr<const FilledHeightfield> terrain =
        filledTerrain(kSide, kSide, hills);
    static Eviction eviction;
    static const TickClock clock;
    const DeviceCapabilities device = desktopDevice();
    const TickOptions options = tickOptionsFor(device);
    LoopSettings settings;
    settings.map = makeServoMap(meterFrame(kSide, kSide), terrain, {});
    const ScenePoint middle = settings.map->frame.toScene({0.5 * kSide, -0.5 * kSide, 0.0});
    settings.frame = {.place = middle, .scene_per_meter = 25000.0};
    settings.frame_number = 1;
    TickState state;
    TickInput input;
    input.settings = &settings;
    input.device = &device;
    std::vector<double> times_us;
    const double speed = kCellsPerTick / settings.frame.scene_per_meter; // meters per tick
    for (std::size_t i = 0; i < ticks; ++i) {
        const double way = speed * static_cast<double>(i);
        input.now += std::chrono::milliseconds(1);
        input.sample.position = {0.06 * std::sin(way / 0.06), 0.04 * std::cos(way / 0.09), -0.0005};
        input.sample.time = input.now;
        if (is_evicted) {
            eviction.run();
        }
        if (is_rehearsed) {
            rehearse(options, input, state, kDt);
        }
        const std::uint64_t begin = TickClock::now();
        step(options, input, state, kDt);
        times_us.push_back(clock.nanoseconds(TickClock::now() - begin) * 1e-3);
    }
    return times_us;
}

void measure(
    const char* name, std::size_t ticks, std::size_t passes, bool is_rehearsed, bool is_evicted)
{
    std::vector<std::vector<double>> all;
    for (std::size_t i = 0; i < passes; ++i) {
        all.push_back(pass(ticks, is_rehearsed, is_evicted));
    }
    std::vector<double> medians;
    for (std::size_t t = 0; t < ticks; ++t) {
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
    const std::size_t ticks = is_brief ? 20 : 1500;
    const std::size_t passes = is_brief ? 1 : 5;
    using marsview::test::measure;
    measure("caches warm", ticks, passes, false, false);
    measure("caches evicted", ticks, passes, false, true);
    measure("caches evicted, then a rehearsal", ticks, passes, true, true);
    return 0;
}
