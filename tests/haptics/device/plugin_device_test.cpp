#include "haptics/device/plugin_device.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <limits>

// The plugin's side; its devices have only what the test needs.
struct MarsviewDevice {
    std::int64_t time_ns = 0;
};

namespace marsview::test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

MarsviewPlugin table()
{
    MarsviewPlugin plugin{};
    plugin.close = [](MarsviewDevice*) {};
    plugin.read = [](MarsviewDevice* device, MarsviewSample* sample) -> std::uint32_t {
        sample->time_ns = device->time_ns;
        return MARSVIEW_FINE;
    };
    return plugin;
}

// The device as the loop receives it.
Clock::time_point timeOfSample(std::int64_t time_ns)
{
    MarsviewDevice theirs{time_ns};
    PluginDevice device(table(), &theirs);
    DeviceSample sample;
    EXPECT_EQ(device.read(sample), DeviceStatus::Fine);
    return sample.time;
}

std::int64_t nanosecondsOf(Clock::time_point time)
{
    return std::chrono::nanoseconds(time.time_since_epoch()).count();
}

TEST(PluginDevice, ASampleWithoutATimeIsOfNow)
{
    const Clock::time_point before = Clock::now();
    const Clock::time_point time = timeOfSample(0);
    EXPECT_GE(time, before);
    EXPECT_LE(time, Clock::now());
}

TEST(PluginDevice, ASampleFromTheFutureIsNotMadeFresh)
{
    // A clock that counts from 1970, and a sample time frozen in the future: repeated reads must
    // give the same time, or the sample would never age.
    for (const std::int64_t ahead_ns : {100'000'000LL, 86'400'000'000'000LL}) {
        const std::int64_t time_ns = nanosecondsOf(Clock::now()) + ahead_ns;
        EXPECT_EQ(nanosecondsOf(timeOfSample(time_ns)), time_ns);
    }
    for (const std::int64_t time_ns : {std::int64_t{1}, std::numeric_limits<std::int64_t>::min(),
                                       std::numeric_limits<std::int64_t>::max()}) {
        EXPECT_EQ(nanosecondsOf(timeOfSample(time_ns)), time_ns);
    }
}

TEST(PluginDevice, ATimeThatWasRoundedUpIsNow)
{
    const Clock::time_point rounded = Clock::now() + 1500us;
    EXPECT_LE(timeOfSample(nanosecondsOf(rounded)), rounded);
    const Clock::time_point time = timeOfSample(nanosecondsOf(Clock::now() + 1500us));
    EXPECT_LE(time, Clock::now());
}

} // namespace
} // namespace marsview::test
