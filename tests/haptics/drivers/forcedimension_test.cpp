// The whole driver, against a stand-in library with the vendor's symbols.
#include "haptics/drivers/forcedimension/dhd_driver.h"
#include "haptics/drivers/forcedimension/dhd_frame.h"
#include "tests/haptics/drivers/stand_in_dhd.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <dlfcn.h>
#include <functional>
#include <thread>

namespace marsview::test {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::StartsWith;

template <typename Function>
Function dhdSymbol(const char* name)
{
    static void* const kLibrary = dlopen(MARSVIEW_STAND_IN_DHD, RTLD_NOW | RTLD_LOCAL);
    EXPECT_NE(kLibrary, nullptr);
    const auto function = reinterpret_cast<Function>(dlsym(kLibrary, name));
    EXPECT_NE(function, nullptr) << name;
    return function;
}

class ForceDimensionDriverTest : public testing::Test {
protected:
    ForceDimensionDriverTest()
    {
        StandInDhd fresh{};
        fresh.devices = 1;
        fresh.type = 33;
        fresh.max_force_n = -1.0;
        fresh.frame[0][0] = fresh.frame[1][1] = fresh.frame[2][2] = 1.0;
        dhdSymbol<StandInDhdSetFunction>("standInDhdSet")(&fresh);
    }

    void TearDown() override
    {
        opened_.reset();
        EXPECT_EQ(now().misuses, 0);
        EXPECT_EQ(now().opened, now().closed);
    }

    static StandInDhd now()
    {
        StandInDhd state;
        dhdSymbol<StandInDhdGetFunction>("standInDhdGet")(&state);
        return state;
    }
    // Between two rounds of the driver some counts may be lost; no test relies on them.
    static void change(const std::function<void(StandInDhd&)>& change)
    {
        StandInDhd state = now();
        change(state);
        dhdSymbol<StandInDhdSetFunction>("standInDhdSet")(&state);
    }

    DhdOptions options() const
    {
        return {.libraries = {folder_.file("not here.so"), MARSVIEW_STAND_IN_DHD},
                .lock_folder = folder_.path() / "locks",
                .patience = std::chrono::minutes(1)};
    }
    HapticDevice& open(std::string_view address = "")
    {
        DhdDriver driver(options());
        auto device = driver.open(address);
        EXPECT_TRUE(device) << device.error().message;
        opened_ = std::move(*device);
        return *opened_;
    }
    // Ticks like the loop, until the condition holds; a minute is forever.
    bool tickUntil(const std::function<bool()>& condition)
    {
        const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
        while (std::chrono::steady_clock::now() < end) {
            read_ = opened_->read(sample_);
            written_ = opened_->write(force_n_);
            if (condition()) {
                return true;
            }
            std::this_thread::sleep_for(milliseconds(1));
        }
        return false;
    }
    bool becomes(DeviceStatus status)
    {
        return tickUntil([&] { return read_ == status; });
    }

    TempFolder folder_;
    std::unique_ptr<HapticDevice> opened_;
    DeviceSample sample_;
    Vec3 force_n_{};
    DeviceStatus read_ = DeviceStatus::Unready;
    DeviceStatus written_ = DeviceStatus::Unready;
};

} // namespace

TEST(ForceDimensionFrame, TurnsTheirAxesIntoOurs)
{
    // In the vendor's frame: 10 mm toward the user, 20 right, 30 up. In ours: right, away, up.
    EXPECT_EQ(fromDhd({0.01, 0.02, 0.03}), (WorkspacePoint{0.02, -0.01, 0.03}));
    EXPECT_EQ(forceToDhd({1.0, 2.0, 3.0}), (std::array<double, 3>{-2.0, 1.0, 3.0}));
}

TEST(ForceDimensionFrame, KeepsTheWorkOfAForce)
{
    const std::array<double, 3> motion{0.3, -0.5, 0.7};
    const Vec3 force{0.4, -1.1, 2.3};
    const std::array<double, 3> theirs = forceToDhd(force);
    EXPECT_NEAR(dot(force, fromDhd(motion) - WorkspacePoint{}),
                theirs[0] * motion[0] + theirs[1] * motion[1] + theirs[2] * motion[2], 1e-15);
}

TEST_F(ForceDimensionDriverTest, SaysThatTheLibraryIsMissing)
{
    DhdOptions none = options();
    none.libraries = {"libdhd-missing.so"};
    DhdDriver driver(none);
    const std::vector<FoundDevice> found = driver.find();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].uri, "forcedimension:");
    EXPECT_THAT(found[0].reason, HasSubstr("SDK is not installed"));
    EXPECT_EQ(found[0].details, "libdhd-missing.so is not installed or may not be read");
    EXPECT_THAT(driver.open("0").error().message,
                StartsWith("forcedimension:0: the Force Dimension SDK is not installed"));
    none.libraries = {"libm.so.6"};
    DhdDriver other(none);
    EXPECT_THAT(other.open("").error().message, HasSubstr("lacks the function dhdGetDeviceCount"));
}

TEST_F(ForceDimensionDriverTest, ListsTheConnectedDevices)
{
    DhdDriver driver(options());
    change([](StandInDhd& s) { s.devices = 2; });
    const std::vector<FoundDevice> found = driver.find();
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].uri, "forcedimension:0");
    EXPECT_EQ(found[1].uri, "forcedimension:1");
    EXPECT_TRUE(found[1].isUsable());
    change([](StandInDhd& s) { s.devices = 0; });
    ASSERT_EQ(driver.find().size(), 1U);
    EXPECT_EQ(driver.find()[0].reason, "no device is connected");
}

TEST_F(ForceDimensionDriverTest, GivesUpOnALibraryThatHangs)
{
    DhdOptions hasty = options();
    hasty.patience = milliseconds(200);
    change([](StandInDhd& s) { s.hangs_counting = 1; });
    DhdDriver driver(hasty);
    EXPECT_THAT(driver.find().at(0).reason, HasSubstr("does not answer"));
    EXPECT_THAT(driver.find().at(0).reason, HasSubstr("does not answer"));
}

TEST_F(ForceDimensionDriverTest, StatesTheLimitsOfEachModel)
{
    struct Case {
        int type;
        const char* name;
        double half_m;
        double force_n;
        double stiffness;
    };
    // The table in the driver's README.
    for (const Case& c : {Case{60, "Novint Falcon (Stand-in)", 0.04, 8.0, 3000.0},
                          Case{33, "Force Dimension omega.3 (Stand-in)", 0.075, 12.0, 5000.0},
                          Case{36, "Force Dimension omega.6 (Stand-in)", 0.075, 12.0, 4000.0},
                          Case{35, "Force Dimension omega.7 (Stand-in)", 0.075, 12.0, 4000.0},
                          Case{63, "Force Dimension delta.3 (Stand-in)", 0.15, 20.0, 4000.0},
                          Case{64, "Force Dimension delta.6 (Stand-in)", 0.15, 20.0, 4000.0},
                          Case{104, "Force Dimension device (Stand-in)", 0.075, 8.0, 1000.0}}) {
        change([&](StandInDhd& s) { s.type = c.type; });
        const DeviceCapabilities& stated = open().capabilities();
        EXPECT_EQ(stated.name, c.name);
        EXPECT_EQ(stated.workspace, (WorkspaceBox{{-c.half_m, -c.half_m, -c.half_m},
                                                  {c.half_m, c.half_m, c.half_m}}));
        EXPECT_EQ(stated.force_n_peak, c.force_n);
        EXPECT_EQ(stated.stiffness_n_per_m_max, c.stiffness);
        EXPECT_EQ(stated.axes_in, 3);
        EXPECT_FALSE(stated.owns_clock);
        opened_.reset();
    }
    change([](StandInDhd& s) { s.max_force_n = 5.0; });
    EXPECT_EQ(open().capabilities().force_n_peak, 5.0) << "a limit that the user has set";
}

TEST_F(ForceDimensionDriverTest, ExchangesPositionButtonsAndForce)
{
    const auto before = std::chrono::steady_clock::now();
    change([](StandInDhd& s) {
        s.position_m[0] = 0.01; // toward the user
        s.position_m[1] = 0.02; // right
        s.position_m[2] = 0.03; // up
        s.is_pressed[1] = 1;
    });
    (void)open("0");
    force_n_ = {0.5, 0.25, -1.0}; // right, away, up
    ASSERT_TRUE(tickUntil([] { return now().force_n[2] == -1.0; }));
    EXPECT_EQ(now().force_n[0], -0.25);
    EXPECT_EQ(now().force_n[1], 0.5);
    EXPECT_EQ(read_, DeviceStatus::Fine);
    EXPECT_EQ(written_, DeviceStatus::Fine);
    EXPECT_EQ(sample_.position, (WorkspacePoint{0.02, -0.01, 0.03}));
    EXPECT_EQ(sample_.buttons, 2U);
    EXPECT_TRUE(sample_.is_held);
    EXPECT_GE(sample_.time, before);
    EXPECT_EQ(sample_.orientation, Orientation{});
    EXPECT_EQ(opened_->trouble(), "");
    // Leaves no force on.
    opened_.reset();
    EXPECT_EQ(now().force_n[2], 0.0);
    EXPECT_EQ(now().is_force_enabled, 0);
}

TEST_F(ForceDimensionDriverTest, ReportsHowTheStylusIsHeld)
{
    // A quarter turn clockwise, seen from above, about the vertical axis: their x axis, toward the
    // user, turns to the left. The tip, which pointed away from the user, then points to the right.
    change([](StandInDhd& s) {
        s.type = 34;
        s.has_wrist = 1;
        const double quarter[3][3] = {{0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
        std::copy(&quarter[0][0], &quarter[0][0] + 9, &s.frame[0][0]);
    });
    EXPECT_EQ(open().capabilities().axes_in, 6);
    ASSERT_TRUE(becomes(DeviceStatus::Fine));
    EXPECT_NEAR(sample_.orientation.w, std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(sample_.orientation.z, -std::sqrt(0.5), 1e-12) << "clockwise about z, up";
    EXPECT_NEAR(sample_.twist_rad, 0.0, 1e-12) << "not about the stylus's own axis";
    // A tenth of a radian clockwise about the stylus itself, seen from its back end toward the tip:
    // negative about their x axis, which leads from the tip to the back end.
    change([](StandInDhd& s) {
        const double c = std::cos(0.1);
        const double n = std::sin(0.1);
        const double rolled[3][3] = {{1.0, 0.0, 0.0}, {0.0, c, n}, {0.0, -n, c}};
        std::copy(&rolled[0][0], &rolled[0][0] + 9, &s.frame[0][0]);
    });
    EXPECT_TRUE(tickUntil([&] { return std::abs(sample_.twist_rad + 0.1) < 1e-12; }))
        << sample_.twist_rad;
}

TEST_F(ForceDimensionDriverTest, IsUnreadyUntilItIsCalibrated)
{
    change([](StandInDhd& s) { s.needs_calibration = 1; });
    (void)open();
    force_n_ = {1.0, 0.0, 0.0};
    ASSERT_TRUE(tickUntil([&] {
        return opened_->trouble() !=
               "does not answer; check its power "
               "and its cable";
    }));
    EXPECT_EQ(read_, DeviceStatus::Unready);
    EXPECT_THAT(opened_->trouble(), HasSubstr("rest position"));
    EXPECT_EQ(now().force_n[1], 0.0);
    change([](StandInDhd& s) { s.needs_calibration = 0; });
    ASSERT_TRUE(becomes(DeviceStatus::Fine)) << "forces are enabled after a calibration";
    EXPECT_TRUE(tickUntil([] { return now().force_n[1] == 1.0; }));
}

TEST_F(ForceDimensionDriverTest, LeavesForcesOffThatTheUserOrTheDeviceTurnedOff)
{
    (void)open();
    force_n_ = {1.0, 0.0, 0.0};
    ASSERT_TRUE(tickUntil([] { return now().force_n[1] == 1.0; }));
    change([](StandInDhd& s) { s.is_braking = 1; });
    ASSERT_TRUE(becomes(DeviceStatus::Unready));
    EXPECT_THAT(opened_->trouble(), HasSubstr("press the force button"));
    EXPECT_TRUE(tickUntil([] { return now().force_n[1] == 0.0; }));
    change([](StandInDhd& s) { s.is_braking = 0; }); // pressed again
    ASSERT_TRUE(becomes(DeviceStatus::Fine));
    EXPECT_TRUE(tickUntil([] { return now().force_n[1] == 1.0; }));
}

TEST_F(ForceDimensionDriverTest, TurnsTheForceOffWhenTheLoopFallsSilent)
{
    (void)open();
    force_n_ = {1.0, 0.0, 0.0};
    ASSERT_TRUE(tickUntil([] { return now().force_n[1] == 1.0; }));
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (now().force_n[1] != 0.0 && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(milliseconds(1));
    }
    EXPECT_EQ(now().force_n[1], 0.0);
}

TEST_F(ForceDimensionDriverTest, IsLostForGoodWhenItIsUnplugged)
{
    (void)open();
    ASSERT_TRUE(becomes(DeviceStatus::Fine));
    change([](StandInDhd& s) { s.is_unplugged = 1; });
    ASSERT_TRUE(becomes(DeviceStatus::Lost));
    EXPECT_THAT(opened_->trouble(), HasSubstr("was unplugged"));
    change([](StandInDhd& s) { s.is_unplugged = 0; });
    EXPECT_EQ(opened_->read(sample_), DeviceStatus::Lost);
    EXPECT_EQ(opened_->write({}), DeviceStatus::Lost);
}

TEST_F(ForceDimensionDriverTest, UsesTheButtonOfAnActiveGripper)
{
    change([](StandInDhd& s) {
        s.type = 35;
        s.has_active_gripper = 1;
        s.is_pressed[0] = 1;
    });
    (void)open();
    EXPECT_TRUE(tickUntil([&] { return sample_.buttons == 1; }));
}

TEST_F(ForceDimensionDriverTest, SaysWhyADeviceCannotBeOpened)
{
    DhdDriver driver(options());
    change([](StandInDhd& s) { s.fails_opening = 1; });
    EXPECT_THAT(driver.open("").error().message,
                StartsWith("forcedimension:: could not be opened (no device found); check"));
    change([](StandInDhd& s) { s.fails_opening = 0; });
    EXPECT_EQ(driver.open("1").error().code, ErrorCode::NotFound);
    EXPECT_THAT(driver.open("1").error().message, HasSubstr("forcedimension:1: is not connected"));
    for (const char* address : {"first", "-1", "1x", "99", " 0"}) {
        EXPECT_THAT(driver.open(address).error().message,
                    HasSubstr("is not the number of a device"))
            << address;
    }
    (void)open("");
    EXPECT_THAT(driver.open("0").error().message, HasSubstr("is in use by this program already"));
}

} // namespace marsview::test
