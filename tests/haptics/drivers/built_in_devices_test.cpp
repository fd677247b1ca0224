// The devices that need no hardware, opened in the same way as in the program.
#include "haptics/device/device_registry.h"
#include "haptics/drivers/built_in_drivers.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <string>
#include <sys/resource.h>
#include <utility>
#include <vector>

namespace marsview::test {
namespace {

std::string refusalOf(const std::string& uri)
{
    const auto device = DeviceRegistry(builtInDrivers()).open(uri);
    return device ? std::string() : device.error().message;
}

std::unique_ptr<HapticDevice> opened(const std::string& uri)
{
    auto device = DeviceRegistry(builtInDrivers()).open(uri);
    EXPECT_TRUE(device) << refusalOf(uri);
    return device ? std::move(device).value() : nullptr;
}

TEST(NullDevice, RestsAndRendersNoForce)
{
    const auto device = opened("null:");
    DeviceSample sample;
    EXPECT_EQ(device->read(sample), DeviceStatus::Fine);
    EXPECT_EQ(sample.position, WorkspacePoint{});
    EXPECT_EQ(device->write({1.0, 2.0, 3.0}), DeviceStatus::Fine);
    EXPECT_EQ(device->capabilities().force_n_peak, 0.0);
    EXPECT_NE(refusalOf("null:mass=1"), "");
}

TEST(SimDevice, DoesTheSameEveryTimeHoweverFastItIsRead)
{
    const auto a = opened("sim:seed=7,tremor_mm=0.2,delay_ms=2,speed=0.1");
    const auto b = opened("sim:seed=7,tremor_mm=0.2,delay_ms=2,speed=0.1");
    const auto other = opened("sim:seed=8,tremor_mm=0.2,delay_ms=2,speed=0.1");
    bool has_differed = false;
    for (int i = 0; i < 3000; ++i) {
        DeviceSample p;
        DeviceSample q;
        DeviceSample r;
        ASSERT_EQ(a->read(p), DeviceStatus::Fine);
        ASSERT_EQ(b->read(q), DeviceStatus::Fine);
        ASSERT_EQ(other->read(r), DeviceStatus::Fine);
        ASSERT_EQ(p.position, q.position);
        has_differed = has_differed || !(p.position == r.position);
        const Vec3 force_n{0.0, 0.0, p.position.z < 0.0 ? -300.0 * p.position.z : 0.0};
        a->write(force_n);
        b->write(force_n);
        other->write(force_n);
    }
    EXPECT_TRUE(has_differed);
}

TEST(SimDevice, PressesDownAndStaysWithinItsWorkspace)
{
    const auto device = opened("sim:press=0.7,lift_s=0,speed=0.1");
    const WorkspaceBox box = device->capabilities().workspace;
    double pressed = 0.0;
    for (int i = 0; i < 20'000; ++i) {
        DeviceSample sample;
        device->read(sample);
        EXPECT_GT(sample.position.x, box.low.x);
        EXPECT_LT(sample.position.x, box.high.x);
        EXPECT_GT(sample.position.y, box.low.y);
        EXPECT_LT(sample.position.y, box.high.y);
        pressed = sample.position.z < 0.0 ? -300.0 * sample.position.z : 0.0;
        device->write({0.0, 0.0, pressed});
    }
    EXPECT_NEAR(pressed, 0.7, 0.05);
}

// By default for half a second every five seconds.
TEST(SimDevice, LiftsOnlyALittle)
{
    const auto device = opened("sim:");
    double highest_m = -1.0;
    int off_ground = 0;
    for (int i = 0; i < 20'000; ++i) {
        DeviceSample sample;
        device->read(sample);
        const double z = sample.position.z;
        device->write({0.0, 0.0, z < 0.0 ? -300.0 * z : 0.0});
        highest_m = std::max(highest_m, z);
        off_ground += z > 0.0 ? 1 : 0;
    }
    EXPECT_GT(off_ground, 1000);
    EXPECT_LT(highest_m, 0.01);
}

TEST(SimDevice, SwipesTheRequestedCellsPerUpdate)
{
    const auto device = opened("sim:swipe=10,cell_m=1e-5,encoder_mm=0,lift_s=0");
    double way_m = 0.0;
    WorkspacePoint last;
    for (int i = 0; i < 10'000; ++i) {
        DeviceSample sample;
        device->read(sample);
        const Vec3 step = sample.position - last;
        way_m += i > 0 ? std::hypot(step.x, step.y) : 0.0;
        last = sample.position;
    }
    EXPECT_NEAR(way_m / 10'000 / 1e-5, 10.0, 1.0); // less while it turns back
}

TEST(SimDevice, StrokesWithinItsRectangle)
{
    const auto device = opened("sim:encoder_mm=0");
    const WorkspaceBox box{{0.02, -0.03, -0.06}, {0.05, -0.01, 0.06}};
    device->strokeWithin(box);
    constexpr int kReturnTicks = 500; // from the middle, which is outside the box
    // the distance by which the hand lags behind its target or overshoots
    constexpr double kTrailM = 0.004;
    WorkspacePoint low{1.0, 1.0, 0.0};
    WorkspacePoint high{-1.0, -1.0, 0.0};
    for (int i = 0; i < 30'000; ++i) {
        DeviceSample sample;
        device->read(sample);
        if (i < kReturnTicks) {
            continue;
        }
        low = {std::min(low.x, sample.position.x), std::min(low.y, sample.position.y), 0.0};
        high = {std::max(high.x, sample.position.x), std::max(high.y, sample.position.y), 0.0};
    }
    EXPECT_GT(low.x, box.low.x - kTrailM);
    EXPECT_LT(high.x, box.high.x + kTrailM);
    EXPECT_GT(low.y, box.low.y - kTrailM);
    EXPECT_LT(high.y, box.high.y + kTrailM);
    // It uses the whole box.
    EXPECT_LT(low.x, box.low.x + kTrailM);
    EXPECT_GT(high.x, box.high.x - kTrailM);
    EXPECT_LT(low.y, box.low.y + kTrailM);
    EXPECT_GT(high.y, box.high.y - kTrailM);
}

// Pressed with 0.7 N onto a slope of 60°, a grip of 150 N/m yields sideways by 8 mm.
TEST(SimDevice, StaysInItsRectangleOnASlopeThatPushesItOut)
{
    const auto device = opened("sim:encoder_mm=0,lift_s=0");
    const WorkspaceBox box{{-0.03, -0.02, -0.06}, {0.03, 0.02, 0.06}};
    device->strokeWithin(box);
    constexpr double kSine = 0.866025403784439;
    constexpr double kTrailM = 0.004;
    int pressed = 0;
    for (int i = 0; i < 30'000; ++i) {
        DeviceSample sample;
        device->read(sample);
        const double depth_m = kSine * sample.position.y - 0.5 * sample.position.z;
        const double force_n = 300.0 * std::max(depth_m, 0.0);
        device->write({0.0, -kSine * force_n, 0.5 * force_n});
        pressed += depth_m > 0.0 ? 1 : 0;
        ASSERT_GT(sample.position.y, box.low.y - kTrailM) << "after " << i << " ms";
        ASSERT_LT(sample.position.y, box.high.y + kTrailM) << "after " << i << " ms";
    }
    EXPECT_GT(pressed, 15'000);
}

TEST(SimDevice, ReturnsOverTheWallOfACanyonOutsideItsRectangle)
{
    const auto device = opened("sim:encoder_mm=0,lift_s=0");
    // A canyon west of 0, 35 mm deep.
    const auto felt_n = [](const WorkspacePoint& at) {
        const double below_rim_m = -0.005 - at.z;
        const double below_floor_m = -0.04 - at.z;
        if (at.x > 0.0 && at.x < below_rim_m) {
            return Vec3{-300.0 * at.x, 0.0, 0.0};
        }
        return Vec3{0.0, 0.0, 300.0 * std::max(at.x > 0.0 ? below_rim_m : below_floor_m, 0.0)};
    };
    DeviceSample sample;
    const auto strokeFor = [&](int ticks) {
        for (int i = 0; i < ticks; ++i) {
            device->read(sample);
            device->write(felt_n(sample.position));
        }
    };
    device->strokeWithin({{-0.04, -0.02, -0.06}, {-0.02, 0.02, 0.06}});
    strokeFor(3000);
    ASSERT_LT(sample.position.z, -0.035);
    device->strokeWithin({{0.02, -0.02, -0.06}, {0.04, 0.02, 0.06}});
    strokeFor(3000);
    EXPECT_GT(sample.position.x, 0.018);
    EXPECT_NEAR(sample.position.z, -0.005, 0.005) << "it presses again";
}

TEST(SimDevice, PressesNoDeeperThanItsBoxAndRisesIntoIt)
{
    const auto device = opened("sim:encoder_mm=0");
    const auto heightAfter = [&](int ticks) {
        DeviceSample sample;
        for (int i = 0; i < ticks; ++i) {
            device->read(sample);
        }
        return sample.position.z;
    };
    EXPECT_LT(heightAfter(2000), -0.02) << "nothing holds it up";
    device->strokeWithin({{-0.05, -0.05, 0.01}, {0.05, 0.05, 0.06}});
    double before = heightAfter(1);
    double fastest = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const double now = heightAfter(1);
        fastest = std::max(fastest, (now - before) * 1e3);
        before = now;
    }
    EXPECT_LT(fastest, 1.0) << "m/s, without a jump";
    for (int i = 0; i < 4000; ++i) {
        ASSERT_GT(heightAfter(1), 0.005);
    }
    device->strokeWithin({{-0.05, -0.05, -0.06}, {0.05, 0.05, 0.06}});
    EXPECT_LT(heightAfter(2000), -0.02);
}

TEST(SimDevice, RefusesUnknownOptions)
{
    EXPECT_EQ(refusalOf("sim:mass=fast"), "sim:mass=fast: mass must be a number from 0.001 to 10");
    EXPECT_EQ(refusalOf("sim:delay_ms=51"),
              "sim:delay_ms=51: delay_ms must be a number from 0 to 50");
    EXPECT_NE(refusalOf("sim:mass=nan"), "");
    EXPECT_NE(refusalOf("sim:mass"), "");
    EXPECT_NE(refusalOf("sim:swipe=3"), ""); // the width is missing
    const std::string unknown = refusalOf("sim:wings=2");
    EXPECT_NE(unknown.find("\"wings\""), std::string::npos) << unknown;
    EXPECT_NE(unknown.find("mass"), std::string::npos) << unknown;
}

TEST(ReplayDevice, ReplaysItsGoalsOnceAndEnds)
{
    const TempFolder folder;
    const std::string path = folder.write("goals.csv", "x,y,z,time_s\n1,2,3,0\n4,5,6.5,0.001\n");
    const auto device = opened("replay:" + path);
    DeviceSample sample;
    RecordedTick tick;
    EXPECT_FALSE(device->recordedTick(tick));
    EXPECT_EQ(device->read(sample), DeviceStatus::Fine);
    ASSERT_TRUE(device->recordedTick(tick));
    EXPECT_EQ(tick.goal, (TracePoint{1.0, 2.0, 3.0}));
    EXPECT_EQ(device->read(sample), DeviceStatus::Fine);
    ASSERT_TRUE(device->recordedTick(tick));
    EXPECT_EQ(tick.goal, (TracePoint{4.0, 5.0, 6.5}));
    EXPECT_EQ(device->read(sample), DeviceStatus::Finished);
    EXPECT_EQ(device->read(sample), DeviceStatus::Finished);
}

TEST(ReplayDevice, RestartsOnRequest)
{
    const TempFolder folder;
    const std::string path = folder.write("goals.csv", "x,y,z\n1,2,3\n4,5,6\n");
    const auto device = opened("replay:" + path + "#loop");
    DeviceSample sample;
    RecordedTick tick;
    for (int i = 0; i < 9; ++i) {
        ASSERT_EQ(device->read(sample), DeviceStatus::Fine);
        ASSERT_TRUE(device->recordedTick(tick));
        EXPECT_EQ(tick.goal.x, i % 2 == 0 ? 1.0 : 4.0);
    }
}

TEST(ReplayDevice, ReportsAnInvalidFile)
{
    const TempFolder folder;
    EXPECT_EQ(
        refusalOf("replay:/nowhere/goals.csv"),
        "replay:/nowhere/goals.csv: cannot be read (No such file or directory); give the path "
        "of a file of goals or of a recording");
    EXPECT_NE(refusalOf("replay:" + folder.path().string()).find("cannot be read (Is a directory)"),
              std::string::npos);
    const std::string nan = folder.write("nan.csv", "x,y,z\n1,2,3\n4,nan,6\n");
    EXPECT_EQ(refusalOf("replay:" + nan),
              "replay:" + nan +
                  ": goal 2 of 2 is at 4, nan, 6, which is not a position; "
                  "remove it");
    EXPECT_NE(refusalOf("replay:"), "");
    EXPECT_NE(refusalOf("replay:" + folder.write("goals.csv", "x,y,z\n")), "");
    const std::string bad = refusalOf("replay:" + folder.write("goals.csv", "x,y,z\n1,2\n"));
    EXPECT_NE(bad.find("line 2"), std::string::npos) << bad;
}

TEST(RecordDevice, NamesTheFileThatItCannotWrite)
{
    const TempFolder folder;
    EXPECT_EQ(refusalOf("record:/dev/full,sim:"),
              "record:/dev/full: cannot be written (No space left on device); free disk space, "
              "or choose another file");
    EXPECT_NE(refusalOf("record:" + folder.path().string() + ",sim:").find("Is a directory"),
              std::string::npos);
    const std::string path = folder.file("a.csv");
    EXPECT_EQ(refusalOf("record:" + path + ",record:" + path + ",sim:"),
              "record:" + path + ": is already being recorded to; choose another file");
    {
        const auto first = opened("record:" + path + ",null:");
        EXPECT_NE(refusalOf("record:" + path + ",sim:"), "");
    }
    EXPECT_TRUE(opened("record:" + path + ",sim:"));
}

TEST(RecordDevice, ReportsThatItsRecordingHasEndedAndContinues)
{
    // Space for the header and little more.
    struct rlimit before {};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const TempFolder folder;
    const std::string path = folder.file("a.csv");
    const auto device = opened("record:" + path + ",sim:");
    DeviceSample sample;
    EXPECT_EQ(device->read(sample), DeviceStatus::Fine);
    EXPECT_EQ(device->trouble(), "");
    // Writing beyond the limit fails, provided that the accompanying signal is ignored.
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    struct rlimit small = before;
    small.rlim_cur = 300;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(device->read(sample), DeviceStatus::Fine);
    }
    const std::string trouble = device->trouble();
    EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, old_handler);
    EXPECT_EQ(trouble, "recording stopped: " + path +
                           ": cannot be written (File too large); choose another file in an "
                           "existing, writable folder");
    EXPECT_EQ(device->read(sample), DeviceStatus::Fine);
}

TEST(RecordDevice, PassesTheDevicesProblemsOn)
{
    const TempFolder folder;
    setenv("XDG_STATE_HOME", folder.path().c_str(), 1); // where plugins leave their marker files
    setenv("XDG_RUNTIME_DIR", folder.path().c_str(), 1);
    const std::string plugin = std::string("plugin:") + MARSVIEW_TEST_PLUGINS + "/says_unready.so";
    const auto device = opened("record:" + folder.file("a.csv") + "," + plugin);
    unsetenv("XDG_STATE_HOME");
    unsetenv("XDG_RUNTIME_DIR");
    DeviceSample sample;
    EXPECT_EQ(device->read(sample), DeviceStatus::Unready);
    EXPECT_EQ(device->trouble().rfind("its plugin reports that it is not ready", 0), 0U);
}

TEST(BuiltInDevices, AreFoundWithoutHardware)
{
    std::vector<std::string> uris;
    for (const FoundDevice& device : DeviceRegistry(builtInDrivers()).find()) {
        uris.push_back(device.uri);
    }
    EXPECT_NE(std::find(uris.begin(), uris.end(), "sim:"), uris.end());
    EXPECT_NE(std::find(uris.begin(), uris.end(), "null:"), uris.end());
}

} // namespace
} // namespace marsview::test
