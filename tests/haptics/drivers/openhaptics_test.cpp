// The whole driver, against a stand-in library with the vendor's symbols.
#include "haptics/drivers/openhaptics/openhaptics_driver.h"
#include "haptics/drivers/openhaptics/openhaptics_frame.h"
#include "tests/haptics/drivers/stand_in_hd.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <dlfcn.h>
#include <functional>
#include <semaphore>
#include <thread>

namespace marsview::test {
namespace {

namespace fs = std::filesystem;
using testing::EndsWith;
using testing::HasSubstr;

template <typename Function>
Function symbol(const char* name)
{
    static void* const kLibrary = dlopen(MARSVIEW_STAND_IN_HD, RTLD_NOW | RTLD_LOCAL);
    EXPECT_NE(kLibrary, nullptr);
    const auto function = reinterpret_cast<Function>(dlsym(kLibrary, name));
    EXPECT_NE(function, nullptr) << name;
    return function;
}

class OpenHapticsDriverTest : public testing::Test {
protected:
    OpenHapticsDriverTest() { symbol<StandInResetFunction>("standInReset")(); }

    void TearDown() override
    {
        opened_.reset();
        EXPECT_EQ(hd().misuses, 0);
        EXPECT_EQ(hd().open_devices, 0);
        EXPECT_EQ(hd().scheduled, 0);
        EXPECT_EQ(hd().scheduler_runs, 0);
    }

    StandInState& hd() { return *symbol<StandInStateFunction>("standInState")(); }
    static void run(int turns) { symbol<StandInRunFunction>("standInRun")(turns); }

    OpenHapticsOptions options() const
    {
        return {.libraries = {folder_.file("not here.so"), MARSVIEW_STAND_IN_HD},
                .config_folders = {folder_.path() / "config"},
                .lock_folder = folder_.path() / "locks",
                .patience = std::chrono::minutes(1)};
    }
    HapticDevice& open(std::string_view name = "")
    {
        OpenHapticsDriver driver(options());
        auto device = driver.open(name);
        EXPECT_TRUE(device) << device.error().message;
        opened_ = std::move(*device);
        return *opened_;
    }
    std::string refusal()
    {
        OpenHapticsDriver driver(options());
        const auto device = driver.open("Left Device");
        EXPECT_FALSE(device);
        return device ? "" : device.error().message;
    }

    // Does the work of a tick and stores the results.
    struct Tick {
        HapticDevice& device;
        Vec3 force_n{};
        DeviceSample sample{};
        DeviceStatus read = DeviceStatus::Lost;
        DeviceStatus written = DeviceStatus::Lost;
        int count = 0;
        std::function<void()> also{};
    };
    static void tick(void* self, std::chrono::steady_clock::time_point) noexcept
    {
        auto* t = static_cast<Tick*>(self);
        t->read = t->device.read(t->sample);
        t->written = t->device.write(t->force_n);
        t->count += 1;
        if (t->also) {
            t->also();
        }
    }

    TempFolder folder_;
    std::unique_ptr<HapticDevice> opened_;
};

} // namespace

TEST(OpenHapticsFrame, TurnsTheirAxesIntoOurs)
{
    // In the vendor's frame: 10 right, 20 up, 30 toward the user. In ours: right, away, up.
    EXPECT_EQ(fromOpenHaptics({10.0, 20.0, 30.0}), (WorkspacePoint{0.01, -0.03, 0.02}));
    EXPECT_EQ(boxFromOpenHaptics({-1.0, -2.0, -3.0, 4.0, 5.0, 6.0}),
              (WorkspaceBox{{-0.001, -0.006, -0.002}, {0.004, 0.003, 0.005}}));
    EXPECT_EQ(forceToOpenHaptics({1.0, 2.0, 3.0}), (std::array<double, 3>{1.0, 3.0, -2.0}));
}

TEST(OpenHapticsFrame, KeepsTheWorkOfAForce)
{
    // The frames differ by a rotation, so force times motion is the same in both.
    const std::array<double, 3> motion_mm{3.0, -5.0, 7.0};
    const Vec3 force{0.4, -1.1, 2.3};
    const std::array<double, 3> theirs = forceToOpenHaptics(force);
    const double theirs_nmm =
        theirs[0] * motion_mm[0] + theirs[1] * motion_mm[1] + theirs[2] * motion_mm[2];
    const Vec3 motion_m = fromOpenHaptics(motion_mm) - WorkspacePoint{};
    EXPECT_NEAR(dot(force, motion_m), theirs_nmm / 1000.0, 1e-15);
}

TEST_F(OpenHapticsDriverTest, SaysThatTheLibraryIsMissing)
{
    OpenHapticsOptions none = options();
    none.libraries = {"libHD-missing.so"};
    OpenHapticsDriver driver(none);
    const std::vector<FoundDevice> found = driver.find();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].uri, "openhaptics:");
    EXPECT_THAT(found[0].reason, HasSubstr("install OpenHaptics"));
    EXPECT_THAT(driver.open("x").error().message,
                testing::StartsWith("openhaptics:x: OpenHaptics is not installed; install "));
}

TEST_F(OpenHapticsDriverTest, RefusesALibraryWithoutItsFunctions)
{
    OpenHapticsOptions other = options();
    other.libraries = {"libm.so.6"};
    OpenHapticsDriver driver(other);
    EXPECT_THAT(driver.open("").error().message, HasSubstr("lacks the function hdInitDevice"));
}

TEST_F(OpenHapticsDriverTest, ListsTheNamesThatTheVendorsSetupLeft)
{
    OpenHapticsDriver driver(options());
    ASSERT_EQ(driver.find().size(), 1U);
    EXPECT_THAT(driver.find()[0].reason, HasSubstr("no device is set up"));
    fs::create_directory(folder_.path() / "config");
    for (const char* name : {"Left Device.config", "Default Device.config", "notes.txt"}) {
        (void)folder_.write(std::string("config/") + name, "ModelType=OMNI\n");
    }
    const std::vector<FoundDevice> found = driver.find();
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].uri, "openhaptics:Default Device");
    EXPECT_EQ(found[1].uri, "openhaptics:Left Device");
    EXPECT_TRUE(found[1].isUsable());
    (void)folder_.write("config/PHANToM0.ini", "");
    EXPECT_EQ(driver.find()[1].uri, "openhaptics:Default PHANToM");
}

TEST_F(OpenHapticsDriverTest, StatesWhatTheDeviceSaysInOurUnits)
{
    const DeviceCapabilities& c = open("Left Device").capabilities();
    EXPECT_STREQ(hd().opened_name, "Left Device");
    EXPECT_EQ(c.name, "3D Systems Touch");
    EXPECT_EQ(c.workspace, (WorkspaceBox{{-0.08, -0.036, -0.06}, {0.081, 0.035, 0.062}}));
    EXPECT_DOUBLE_EQ(c.stiffness_n_per_m_max, 1020.0);
    EXPECT_EQ(c.force_n_peak, 3.3);
    EXPECT_EQ(c.force_n_continuous, 0.88);
    EXPECT_EQ(c.rate_hz, 1000.0);
    EXPECT_EQ(c.axes_in, 6);
    EXPECT_TRUE(c.owns_clock);
    EXPECT_TRUE(c.has_presence);
    opened_.reset();
    (void)open();
    EXPECT_STREQ(hd().opened_name, "(default)");
}

TEST_F(OpenHapticsDriverTest, BelievesForceNumbersOnlyWhereTheyAreSane)
{
    hd().numbers_are_shifted = 1;
    EXPECT_DOUBLE_EQ(open().capabilities().stiffness_n_per_m_max, 1020.0);
    EXPECT_EQ(opened_->capabilities().force_n_peak, 3.3);
    EXPECT_EQ(opened_->capabilities().force_n_continuous, 0.88);
    opened_.reset();
    hd().numbers_are_insane = 1;
    const DeviceCapabilities& c = open().capabilities();
    EXPECT_EQ(c.stiffness_n_per_m_max, 1000.0);
    EXPECT_EQ(c.force_n_peak, 3.3);
}

TEST_F(OpenHapticsDriverTest, DrivesTheTickFromTheVendorsScheduler)
{
    HapticDevice& device = open();
    DeviceSample outside;
    EXPECT_EQ(device.read(outside), DeviceStatus::Unready) << "outside a tick";
    hd().position_mm[0] = 10.0;
    hd().position_mm[1] = 20.0;
    hd().position_mm[2] = 30.0;
    hd().stylus_clockwise_rad = 0.75;
    hd().buttons = 3;
    Tick state{.device = device, .force_n = {0.5, 0.25, -1.0}};
    const auto before = std::chrono::steady_clock::now();
    ASSERT_TRUE(device.startClock(tick, &state));
    EXPECT_EQ(hd().scheduler_hz, 1000U);
    run(5);
    EXPECT_EQ(state.count, 5);
    EXPECT_EQ(state.read, DeviceStatus::Fine);
    EXPECT_EQ(state.written, DeviceStatus::Fine);
    EXPECT_EQ(state.sample.position, (WorkspacePoint{0.01, -0.03, 0.02}));
    EXPECT_EQ(state.sample.twist_rad, -0.75) << "positive counter-clockwise";
    EXPECT_EQ(state.sample.buttons, 3U);
    EXPECT_TRUE(state.sample.is_held);
    EXPECT_GE(state.sample.time, before);
    EXPECT_EQ(hd().force_n[0], 0.5);
    EXPECT_EQ(hd().force_n[1], -1.0);  // up
    EXPECT_EQ(hd().force_n[2], -0.25); // toward the user
    device.stopClock();
    EXPECT_EQ(hd().frames, 5U);
    EXPECT_EQ(hd().scheduler_runs, 0);
}

TEST_F(OpenHapticsDriverTest, TellsTheInkwell)
{
    HapticDevice& device = open();
    Tick state{.device = device};
    ASSERT_TRUE(device.startClock(tick, &state));
    hd().inkwell_switch = 0;
    run(1);
    EXPECT_FALSE(state.sample.is_held);
    hd().inkwell_switch = 1;
    run(1);
    EXPECT_TRUE(state.sample.is_held);
    device.stopClock();
    opened_.reset();

    hd().calibration_style = 1; // a Premium: no inkwell; the state of its switch is meaningless
    hd().inkwell_switch = 0;
    HapticDevice& arm = open();
    EXPECT_FALSE(arm.capabilities().has_presence);
    Tick other{.device = arm};
    ASSERT_TRUE(arm.startClock(tick, &other));
    run(1);
    EXPECT_EQ(other.read, DeviceStatus::Fine);
    EXPECT_TRUE(other.sample.is_held);
}

namespace {

// The direction in the workspace of what points along `v` in the reference orientation.
Vec3 turned(const Orientation& o, const Vec3& v)
{
    const Vec3 axis{o.x, o.y, o.z};
    const Vec3 t = cross(axis, v) * 2.0;
    return v + t * o.w + cross(axis, t);
}

constexpr Vec3 kTip{0.0, 1.0, 0.0}; // level, away from the user
constexpr Vec3 kTop{0.0, 0.0, 1.0}; // a mark on the upper side of the level stylus

void expectDirection(const Vec3& v, const Vec3& expected)
{
    EXPECT_NEAR(v.x, expected.x, 1e-12);
    EXPECT_NEAR(v.y, expected.y, 1e-12);
    EXPECT_NEAR(v.z, expected.z, 1e-12);
}

} // namespace

// The device is put into a pose; the table in the driver's README says what its library reports.
TEST_F(OpenHapticsDriverTest, ReportsHowTheStylusIsHeld)
{
    HapticDevice& device = open();
    Tick state{.device = device};
    ASSERT_TRUE(device.startClock(tick, &state));
    const auto pose = [&](const Vec3& tip_to_back, double clockwise_rad) {
        hd().stylus_axis[0] = tip_to_back.x;
        hd().stylus_axis[1] = tip_to_back.y;
        hd().stylus_axis[2] = tip_to_back.z;
        hd().stylus_clockwise_rad = clockwise_rad;
        run(1);
        return state.sample;
    };
    // In their axes: x right, y up, z toward the user. Level, the tip away from the user.
    DeviceSample sample = pose({0.0, 0.0, 1.0}, 0.0);
    EXPECT_EQ(sample.orientation, Orientation{});
    // The tip down: the upper side points away from the user.
    sample = pose({0.0, 1.0, 0.0}, 0.0);
    expectDirection(turned(sample.orientation, kTip), {0.0, 0.0, -1.0});
    expectDirection(turned(sample.orientation, kTop), {0.0, 1.0, 0.0});
    EXPECT_NEAR(sample.twist_rad, 0.0, 1e-15);
    // Then turned clockwise by a right angle, seen from above: from away from the user to the
    // right.
    sample = pose({0.0, 1.0, 0.0}, 1.5707963267948966);
    expectDirection(turned(sample.orientation, kTip), {0.0, 0.0, -1.0});
    expectDirection(turned(sample.orientation, kTop), {1.0, 0.0, 0.0});
    EXPECT_NEAR(sample.twist_rad, -1.5707963267948966, 1e-12);
    EXPECT_NEAR(twistOf(sample.orientation), sample.twist_rad, 1e-12);
    // The tip to the right.
    sample = pose({-1.0, 0.0, 0.0}, 0.0);
    expectDirection(turned(sample.orientation, kTip), {1.0, 0.0, 0.0});
}

TEST_F(OpenHapticsDriverTest, PassesBothButtonsOn)
{
    HapticDevice& device = open();
    EXPECT_EQ(device.capabilities().buttons, 2);
    Tick state{.device = device};
    ASSERT_TRUE(device.startClock(tick, &state));
    for (const int buttons : {0, 1, 2, 3}) {
        hd().buttons = buttons;
        run(1);
        EXPECT_EQ(state.sample.buttons, static_cast<std::uint32_t>(buttons));
    }
}

// A device without calibration of its own: the PHANTOM Premium.
TEST_F(OpenHapticsDriverTest, ResetsEncodersOnlyWhereAPersonHoldsTheNeutralPosition)
{
    hd().calibration_style = 1;
    hd().position_mm[0] = 30.0; // where it stands in the axes of its calibrated state
    for (const unsigned needs : {0x5001U, 0x5002U}) {
        hd().calibration = needs;
        HapticDevice& device = open("Left Device");
        EXPECT_TRUE(device.capabilities().can_set_home);
        Tick state{.device = device, .force_n = {1.0, 0.0, 0.0}};
        ASSERT_TRUE(device.startClock(tick, &state));
        run(300);
        EXPECT_EQ(state.read, DeviceStatus::Unready);
        EXPECT_EQ(hd().force_n[0], 0.0);
        EXPECT_EQ(hd().encoder_resets, 0) << "the current pose is not the neutral one";
        EXPECT_THAT(device.trouble(), HasSubstr("neutral position"));
        EXPECT_THAT(device.trouble(), HasSubstr("Set Home Position"));
        EXPECT_THAT(device.trouble(), testing::Not(HasSubstr("inkwell")));
        device.stopClock();
        opened_.reset();
    }
    HapticDevice& device = open("Left Device,home");
    EXPECT_STREQ(hd().opened_name, "Left Device");
    EXPECT_EQ(hd().encoder_resets, 1);
    EXPECT_EQ(hd().updated_style, 1U);
    Tick state{.device = device, .force_n = {1.0, 0.0, 0.0}};
    ASSERT_TRUE(device.startClock(tick, &state));
    run(1);
    EXPECT_EQ(state.read, DeviceStatus::Fine);
    EXPECT_EQ(state.sample.position, WorkspacePoint{});
    EXPECT_EQ(hd().force_n[0], 1.0);
    hd().position_mm[0] = 40.0;
    run(1);
    EXPECT_EQ(state.sample.position, (WorkspacePoint{0.01, 0.0, 0.0}));
    EXPECT_EQ(device.trouble(), "");
}

TEST_F(OpenHapticsDriverTest, RefusesToResetTheEncodersOfOtherDevices)
{
    OpenHapticsDriver driver(options());
    for (const unsigned styles : {2U, 4U, 6U, 5U, 3U}) {
        hd().calibration_style = styles;
        const auto device = driver.open("Left Device,home");
        ASSERT_FALSE(device) << styles;
        EXPECT_THAT(device.error().message,
                    HasSubstr("openhaptics:Left Device,home: has no encoders to reset"));
    }
    EXPECT_EQ(hd().encoder_resets, 0);
}

TEST_F(OpenHapticsDriverTest, AdvisesWhatTheDevicesCalibrationNeeds)
{
    struct Case {
        unsigned styles;
        unsigned char inkwell_switch; // 1: the stylus is not in it
        const char* advice;
    };
    const std::string start = "is not calibrated";
    for (const Case& c : {Case{4, 1, "; put the stylus into the inkwell"},
                          Case{2, 1, " yet; move the stylus through its workspace"},
                          Case{6, 1,
                               " yet; move the stylus through its workspace, or put it into "
                               "the inkwell"},
                          Case{5, 1, "; put the stylus into the inkwell"}, // prefers the inkwell
                          Case{0, 1,
                               "; calibrate it with the vendor's setup program "
                               "(Touch_Setup)"}}) {
        hd().calibration_style = c.styles;
        hd().calibration = 0x5002;
        hd().inkwell_switch = c.inkwell_switch;
        HapticDevice& device = open();
        Tick state{.device = device};
        ASSERT_TRUE(device.startClock(tick, &state));
        run(2);
        EXPECT_EQ(state.read, DeviceStatus::Unready);
        EXPECT_EQ(device.trouble(), start + c.advice) << c.styles;
        device.stopClock();
        opened_.reset();
    }
}

TEST_F(OpenHapticsDriverTest, IsCalibratedInTheInkwell)
{
    hd().calibration = 0x5001;
    HapticDevice& device = open();
    Tick state{.device = device};
    ASSERT_TRUE(device.startClock(tick, &state));
    run(3);
    EXPECT_EQ(state.read, DeviceStatus::Unready) << "the stylus is not in the inkwell";
    hd().inkwell_switch = 0;
    run(2);
    EXPECT_EQ(state.read, DeviceStatus::Fine);
    EXPECT_FALSE(state.sample.is_held);
    EXPECT_EQ(hd().updated_style, 4U);
    hd().inkwell_switch = 1;
    run(1);
    EXPECT_EQ(state.read, DeviceStatus::Fine);
    EXPECT_TRUE(state.sample.is_held);
}

TEST_F(OpenHapticsDriverTest, IsUnreadyUntilItIsCalibrated)
{
    hd().calibration_style = 2; // by motion
    hd().calibration = 0x5002;
    HapticDevice& device = open();
    Tick state{.device = device, .force_n = {1.0, 0.0, 0.0}};
    ASSERT_TRUE(device.startClock(tick, &state));
    run(3);
    EXPECT_EQ(state.read, DeviceStatus::Unready);
    EXPECT_EQ(state.written, DeviceStatus::Unready);
    EXPECT_EQ(hd().force_n[0], 0.0);
    EXPECT_THAT(device.trouble(), HasSubstr("not calibrated"));
    EXPECT_EQ(hd().updated_style, 0U);
    hd().calibration = 0x5001;
    run(2);
    EXPECT_EQ(hd().updated_style, 2U);
    EXPECT_EQ(state.read, DeviceStatus::Fine);
    EXPECT_EQ(hd().force_n[0], 1.0);
    EXPECT_EQ(device.trouble(), "");
    hd().calibration = 0x5002; // uncalibrated again, as after a stall of its encoders
    run(250);
    EXPECT_EQ(state.read, DeviceStatus::Unready);
}

TEST_F(OpenHapticsDriverTest, IsLostForGoodWhenItIsUnplugged)
{
    HapticDevice& device = open();
    Tick state{.device = device, .force_n = {1.0, 0.0, 0.0}};
    ASSERT_TRUE(device.startClock(tick, &state));
    run(3);
    EXPECT_EQ(state.read, DeviceStatus::Fine);
    hd().frame_error = 0x0302;
    run(2);
    EXPECT_EQ(state.read, DeviceStatus::Lost);
    EXPECT_EQ(state.written, DeviceStatus::Lost);
    EXPECT_THAT(device.trouble(), HasSubstr("does not answer"));
    hd().frame_error = 0;
    run(2);
    EXPECT_EQ(state.read, DeviceStatus::Lost);
    EXPECT_EQ(hd().force_n[0], 0.0);
    EXPECT_EQ(state.count, 7) << "the loop still learns of it";
}

TEST_F(OpenHapticsDriverTest, RestsAfterAnErrorOfForcesAndGoesOn)
{
    HapticDevice& device = open();
    Tick state{.device = device, .force_n = {1.0, 0.0, 0.0}};
    ASSERT_TRUE(device.startClock(tick, &state));
    run(3);
    hd().frame_error = 0x0200; // warm motors
    run(1);
    hd().frame_error = 0;
    run(1);
    EXPECT_EQ(state.read, DeviceStatus::Unready);
    EXPECT_THAT(device.trouble(), HasSubstr("overheated"));
    EXPECT_EQ(hd().enabled_force_output, 0U);
    run(498);
    EXPECT_EQ(state.read, DeviceStatus::Unready);
    run(2);
    EXPECT_EQ(state.read, DeviceStatus::Fine);
    EXPECT_EQ(hd().force_n[0], 1.0);
    EXPECT_EQ(device.trouble(), "");
}

TEST_F(OpenHapticsDriverTest, LeavesNoForceOnWhereTheTickWritesNone)
{
    HapticDevice& device = open();
    Tick state{.device = device, .force_n = {2.0, 0.0, 0.0}};
    ASSERT_TRUE(device.startClock(tick, &state));
    run(2);
    EXPECT_EQ(hd().force_n[0], 2.0);
    device.stopClock();
    ASSERT_TRUE(
        device.startClock([](void*, std::chrono::steady_clock::time_point) noexcept {}, nullptr));
    run(1);
    EXPECT_EQ(hd().force_n[0], 0.0);
}

TEST_F(OpenHapticsDriverTest, TellsByTheSamplesAgeThatTheBusStalls)
{
    HapticDevice& device = open();
    Tick state{.device = device};
    std::chrono::nanoseconds age{};
    state.also = [&] { age = std::chrono::steady_clock::now() - state.sample.time; };
    ASSERT_TRUE(device.startClock(tick, &state));
    hd().stall_ms = 30;
    run(1);
    EXPECT_EQ(state.read, DeviceStatus::Fine);
    EXPECT_GE(age, std::chrono::milliseconds(30)) << "a late sample may have been measured early";
}

TEST_F(OpenHapticsDriverTest, WaitsForAFrameThatHasBegunWhenItStops)
{
    HapticDevice& device = open();
    std::binary_semaphore has_begun{0};
    std::binary_semaphore may_end{0};
    std::atomic<bool> has_ended{false};
    Tick state{.device = device};
    state.also = [&] {
        has_begun.release();
        may_end.acquire();
        has_ended = true;
    };
    ASSERT_TRUE(device.startClock(tick, &state));
    std::thread frames([] { run(1); });
    has_begun.acquire();
    bool had_ended = false;
    std::thread stopper([&] {
        device.stopClock();
        had_ended = has_ended;
    });
    may_end.release();
    stopper.join();
    frames.join();
    EXPECT_TRUE(had_ended);
    EXPECT_EQ(state.count, 1);
}

TEST_F(OpenHapticsDriverTest, SaysWhyTheLibraryRefusesADevice)
{
    struct Case {
        unsigned error;
        const char* part;
    };
    for (const Case& c : {Case{0x0302, "openhaptics:Left Device: does not answer"},
                          Case{0x0301, "is in use by another program"},
                          Case{0x0303, "run the vendor's setup program"}, Case{0x0600, "license"},
                          Case{0x0300, "error 0x0300 of OpenHaptics"}}) {
        hd().init_error = c.error;
        EXPECT_THAT(refusal(), HasSubstr(c.part));
    }
}

TEST_F(OpenHapticsDriverTest, DoesNotStartWhereTheSchedulerDoesNot)
{
    HapticDevice& device = open();
    Tick state{.device = device};
    hd().start_error = 0x0304;
    EXPECT_FALSE(device.startClock(tick, &state));
    EXPECT_THAT(device.trouble(), HasSubstr("0x0304"));
    EXPECT_EQ(hd().scheduled, 0);
    hd().start_error = 0;
    EXPECT_TRUE(device.startClock(tick, &state));
}

TEST_F(OpenHapticsDriverTest, GivesOneDeviceToOneHolderOnly)
{
    (void)open("Left Device");
    EXPECT_EQ(refusal(),
              "openhaptics:Left Device: is in use by this program already; close it "
              "there first");
    opened_.reset();
    (void)open("Left Device");
}

TEST_F(OpenHapticsDriverTest, GivesTheDefaultDeviceToOneHolderByEitherName)
{
    const auto refusalOf = [this](const char* name) {
        OpenHapticsDriver driver(options());
        const auto device = driver.open(name);
        EXPECT_FALSE(device) << name;
        return device ? "" : device.error().message;
    };
    const std::string in_use = ": is in use by this program already; close it there first";
    (void)open("");
    EXPECT_EQ(refusalOf("Default Device"), "openhaptics:Default Device" + in_use);
    opened_.reset();
    (void)open("Default Device");
    EXPECT_EQ(refusalOf(""), "openhaptics:Default Device" + in_use);
    opened_.reset();
    // The drivers for FireWire devices use another name for it.
    fs::create_directories(folder_.path() / "config");
    (void)folder_.write("config/0.ini", "");
    (void)open("");
    EXPECT_EQ(refusalOf("Default PHANToM"), "openhaptics:Default PHANToM" + in_use);
}

TEST_F(OpenHapticsDriverTest, GivesUpOnALibraryThatHangs)
{
    OpenHapticsOptions hasty = options();
    hasty.patience = std::chrono::milliseconds(200);
    hd().inits_that_hang = 1;
    OpenHapticsDriver driver(hasty);
    EXPECT_THAT(driver.open("").error().message, HasSubstr("did not open it within"));
}

} // namespace marsview::test
