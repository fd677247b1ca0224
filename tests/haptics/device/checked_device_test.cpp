#include "haptics/device/capability_check.h"
#include "haptics/device/checked_device.h"
#include "tests/support/nan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace marsview::test {
namespace {

using Clock = std::chrono::steady_clock;
using testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

DeviceCapabilities possible()
{
    DeviceCapabilities c;
    c.name = "Desk arm";
    c.workspace = {{-0.1, -0.1, 0.0}, {0.1, 0.1, 0.2}};
    c.force_n_peak = 5.0;
    c.force_n_continuous = 1.5;
    c.stiffness_n_per_m_max = 1000.0;
    return c;
}

// Returns what the test has set, and records the forces written.
struct Script {
    DeviceSample next;
    DeviceStatus status = DeviceStatus::Fine;
    std::vector<Vec3> forces;
};

class ScriptedDevice final : public HapticDevice {
public:
    explicit ScriptedDevice(Script& script)
        : script_(script)
    {}
    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override
    {
        if (script_.status == DeviceStatus::Fine) {
            sample = script_.next;
        }
        return script_.status;
    }
    DeviceStatus write(const Vec3& force_n) noexcept override
    {
        script_.forces.push_back(force_n);
        return script_.status;
    }

private:
    Script& script_;
    DeviceCapabilities capabilities_ = possible();
};

class CheckedDeviceTest : public testing::Test {
protected:
    DeviceStatus readAt(WorkspacePoint position, std::chrono::microseconds after)
    {
        now_ += after;
        script_.next.position = position;
        script_.next.time = now_;
        return device_.read(sample_);
    }

    Script script_;
    CheckedDevice device_{std::make_unique<ScriptedDevice>(script_)};
    DeviceSample sample_;
    Clock::time_point now_ = Clock::now();
};

constexpr std::chrono::microseconds kPeriod{1000};

} // namespace

TEST_F(CheckedDeviceTest, AcceptsAFastHand)
{
    // 8 m/s back and forth is faster than anyone moves a stylus.
    for (int i = 0; i < 1000; ++i) {
        const double x = 0.05 * std::sin(160.0 * 0.001 * i);
        ASSERT_EQ(readAt({x, 0.0, 0.1}, kPeriod), DeviceStatus::Fine) << i;
        ASSERT_EQ(sample_.position.x, x);
    }
    EXPECT_EQ(device_.trouble(), "");
}

TEST_F(CheckedDeviceTest, WithholdsOneBadSampleAndContinues)
{
    ASSERT_EQ(readAt({0.0, 0.0, 0.1}, kPeriod), DeviceStatus::Fine);
    EXPECT_EQ(readAt({0.0, kInfinity, 0.1}, kPeriod), DeviceStatus::Unready);
    EXPECT_EQ(sample_.position, (WorkspacePoint{0.0, 0.0, 0.1}));
    ASSERT_EQ(script_.forces.size(), 1U);
    EXPECT_EQ(script_.forces.back(), Vec3{}) << "no force stays on";
    EXPECT_EQ(readAt({0.001, 0.0, 0.1}, kPeriod), DeviceStatus::Fine);
    EXPECT_EQ(sample_.position.x, 0.001);
    EXPECT_EQ(device_.trouble(), "");
}

TEST_F(CheckedDeviceTest, TheForceStaysZeroUntilASampleIsPlausible)
{
    ASSERT_EQ(readAt({0.0, 0.0, 0.1}, kPeriod), DeviceStatus::Fine);
    EXPECT_EQ(device_.write({0.0, 0.0, 2.0}), DeviceStatus::Fine);
    EXPECT_EQ(readAt({0.0, kNan, 0.1}, kPeriod), DeviceStatus::Unready);
    // A loop lets its force fade after a failed read, and would switch it on again.
    EXPECT_EQ(device_.write({0.0, 0.0, 1.0}), DeviceStatus::Unready);
    EXPECT_EQ(script_.forces.back(), Vec3{});
    EXPECT_EQ(readAt({0.0, 0.0, 0.1}, kPeriod), DeviceStatus::Fine);
    EXPECT_EQ(device_.write({0.0, 0.0, 1.0}), DeviceStatus::Fine);
    EXPECT_EQ(script_.forces.back().z, 1.0);
}

TEST_F(CheckedDeviceTest, AcceptsAnyTimes)
{
    for (const auto time : {Clock::time_point::min(), Clock::time_point::max(), now_,
                            Clock::time_point::min(), now_}) {
        script_.next.time = time;
        EXPECT_EQ(device_.read(sample_), DeviceStatus::Fine);
        EXPECT_EQ(sample_.time, time) << "the loop judges the age of a sample";
    }
}

TEST_F(CheckedDeviceTest, DropsADeviceThatJumps)
{
    ASSERT_EQ(readAt({-0.1, 0.0, 0.1}, kPeriod), DeviceStatus::Fine);
    // 200 mm in a millisecond are 200 m/s, and 67 m/s after three.
    EXPECT_EQ(readAt({0.1, 0.0, 0.1}, kPeriod), DeviceStatus::Unready);
    EXPECT_EQ(readAt({0.1, 0.0, 0.1}, kPeriod), DeviceStatus::Unready);
    EXPECT_EQ(readAt({0.1, 0.0, 0.1}, kPeriod), DeviceStatus::Lost);
    EXPECT_THAT(device_.trouble(), HasSubstr("jumps"));
    EXPECT_EQ(readAt({-0.1, 0.0, 0.1}, kPeriod), DeviceStatus::Lost) << "permanently";
    EXPECT_EQ(device_.write({1.0, 0.0, 0.0}), DeviceStatus::Lost);
    EXPECT_EQ(script_.forces.back(), Vec3{});
}

TEST_F(CheckedDeviceTest, AcceptsASlipOfAnEncoderAfterAMoment)
{
    ASSERT_EQ(readAt({0.0, 0.0, 0.1}, kPeriod), DeviceStatus::Fine);
    EXPECT_EQ(readAt({0.05, 0.0, 0.1}, kPeriod), DeviceStatus::Unready);
    EXPECT_EQ(readAt({0.05, 0.0, 0.1}, kPeriod), DeviceStatus::Fine); // 25 m/s, less the step
}

TEST_F(CheckedDeviceTest, AcceptsAnotherPlaceAfterAPause)
{
    ASSERT_EQ(readAt({-0.1, 0.0, 0.0}, kPeriod), DeviceStatus::Fine);
    EXPECT_EQ(readAt({0.1, 0.0, 0.2}, std::chrono::milliseconds(150)), DeviceStatus::Fine);
}

TEST_F(CheckedDeviceTest, DropsADeviceIfEveryThirdSampleIsBad)
{
    DeviceStatus status = DeviceStatus::Fine;
    int reads = 0;
    for (; reads < 100 && status != DeviceStatus::Lost; ++reads) {
        status = readAt({reads % 3 == 2 ? kNan : 0.0, 0.0, 0.1}, kPeriod);
    }
    EXPECT_EQ(status, DeviceStatus::Lost);
    EXPECT_LT(reads, 30);
}

TEST_F(CheckedDeviceTest, KeepsADeviceIfOneSampleInTenIsBad)
{
    for (int i = 0; i < 10'000; ++i) {
        const DeviceStatus expected = i % 10 == 9 ? DeviceStatus::Unready : DeviceStatus::Fine;
        ASSERT_EQ(readAt({i % 10 == 9 ? kNan : 0.0, 0.0, 0.1}, kPeriod), expected) << i;
    }
}

TEST_F(CheckedDeviceTest, RefusesPositionsFarOutsideButNotJustOutside)
{
    EXPECT_EQ(readAt({0.25, -0.29, 0.39}, kPeriod), DeviceStatus::Fine);
    EXPECT_EQ(readAt({0.25, -0.31, 0.39}, kPeriod), DeviceStatus::Unready);
    EXPECT_THAT(device_.trouble(), HasSubstr("outside"));
}

TEST_F(CheckedDeviceTest, ClampsForcesAndWritesZeroForInvalidOnes)
{
    EXPECT_EQ(device_.write({3.0, 0.0, -4.0}), DeviceStatus::Fine);
    EXPECT_EQ(script_.forces.back(), (Vec3{3.0, 0.0, -4.0}));
    EXPECT_EQ(device_.write({30.0, 0.0, -40.0}), DeviceStatus::Fine);
    EXPECT_NEAR(script_.forces.back().x, 3.0, 1e-12);
    EXPECT_NEAR(script_.forces.back().z, -4.0, 1e-12);
    for (const Vec3& force : {Vec3{kNan, 0.0, 0.0}, Vec3{0.0, kInfinity, 0.0}}) {
        EXPECT_EQ(device_.write(force), DeviceStatus::Fine);
        EXPECT_EQ(script_.forces.back(), Vec3{});
    }
}

TEST_F(CheckedDeviceTest, PassesTheDevicesMessagesOn)
{
    script_.status = DeviceStatus::Unready;
    EXPECT_EQ(readAt({}, kPeriod), DeviceStatus::Unready);
    script_.status = DeviceStatus::Finished;
    EXPECT_EQ(readAt({}, kPeriod), DeviceStatus::Finished);
    script_.status = DeviceStatus::Lost;
    EXPECT_EQ(readAt({}, kPeriod), DeviceStatus::Lost);
    script_.status = DeviceStatus::Fine;
    EXPECT_EQ(readAt({}, kPeriod), DeviceStatus::Lost) << "it never recovers";
}

TEST(CapabilityCheck, DistinguishesPlausibleFromImplausibleValues)
{
    EXPECT_EQ(impossibilityOf(possible()), std::nullopt);
    DeviceCapabilities feels_only = possible();
    feels_only.force_n_peak = feels_only.force_n_continuous = 0.0;
    feels_only.axes_out = 0;
    EXPECT_EQ(impossibilityOf(feels_only), std::nullopt);
    DeviceCapabilities slow = possible();
    slow.rate_hz = 200.0;
    slow.stiffness_n_per_m_max = 0.0; // not stated
    EXPECT_EQ(impossibilityOf(slow), std::nullopt);

    struct Case {
        const char* part_of_complaint;
        void (*spoil)(DeviceCapabilities& c);
    };
    for (const Case& c : {
             Case{"along x", [](DeviceCapabilities& d) { d.workspace.low.x = kNan; }},
             Case{"from 0 to 0 m along z", [](DeviceCapabilities& d) { d.workspace.high.z = 0; }},
             Case{"along y", [](DeviceCapabilities& d) { d.workspace.high.y = 100.0; }},
             Case{"along y",
                  [](DeviceCapabilities& d) { std::swap(d.workspace.low.y, d.workspace.high.y); }},
             Case{"peak force", [](DeviceCapabilities& d) { d.force_n_peak = kInfinity; }},
             Case{"-1 N", [](DeviceCapabilities& d) { d.force_n_continuous = -1.0; }},
             Case{"above its peak", [](DeviceCapabilities& d) { d.force_n_continuous = 6.0; }},
             Case{"peak torque of -1 N·m", [](DeviceCapabilities& d) { d.torque_nm_peak = -1.0; }},
             Case{"stiffness", [](DeviceCapabilities& d) { d.stiffness_n_per_m_max = 1e9; }},
             Case{"rate of 0 Hz", [](DeviceCapabilities& d) { d.rate_hz = 0.0; }},
             Case{"rate of 1 Hz", [](DeviceCapabilities& d) { d.rate_hz = 1.0; }},
             Case{"rate of 199 Hz", [](DeviceCapabilities& d) { d.rate_hz = 199.0; }},
             Case{"rate of 100000 Hz", [](DeviceCapabilities& d) { d.rate_hz = 1e5; }},
             Case{"axes", [](DeviceCapabilities& d) { d.axes_in = 0; }},
             Case{"axes", [](DeviceCapabilities& d) { d.axes_out = 7; }},
             Case{"33 buttons", [](DeviceCapabilities& d) { d.buttons = 33; }},
         }) {
        DeviceCapabilities spoilt = possible();
        c.spoil(spoilt);
        const auto complaint = impossibilityOf(spoilt);
        ASSERT_TRUE(complaint) << c.part_of_complaint;
        EXPECT_THAT(*complaint, HasSubstr(c.part_of_complaint));
    }
}

} // namespace marsview::test
