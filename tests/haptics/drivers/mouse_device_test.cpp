#include "haptics/device/capability_check.h"
#include "haptics/drivers/mouse/mouse_driver.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>

namespace marsview::test {
namespace {

std::unique_ptr<HapticDevice> opened(const std::shared_ptr<MouseLink>& link)
{
    MouseDriver driver(link);
    auto device = driver.open("");
    EXPECT_TRUE(device) << device.error().message;
    return std::move(*device);
}

} // namespace

TEST(MouseDevice, SaysWhatTheWindowSays)
{
    const auto link = std::make_shared<MouseLink>();
    const auto device = opened(link);
    EXPECT_EQ(impossibilityOf(device->capabilities()), std::nullopt);
    DeviceSample sample;
    ASSERT_EQ(device->read(sample), DeviceStatus::Fine);
    EXPECT_FALSE(sample.is_held) << "before the first touch";
    const auto before = std::chrono::steady_clock::now();
    link->setPointer(
        {.position = {0.01, -0.02, 0.03}, .twist_rad = 0.5, .buttons = 1, .is_held = true});
    ASSERT_EQ(device->read(sample), DeviceStatus::Fine);
    EXPECT_EQ(sample.position, (WorkspacePoint{0.01, -0.02, 0.03}));
    EXPECT_EQ(sample.twist_rad, 0.5);
    EXPECT_EQ(sample.buttons, 1U);
    EXPECT_TRUE(sample.is_held);
    EXPECT_GE(sample.time, before);
}

TEST(MouseDevice, StaysInItsWorkspaceAndFinite)
{
    const auto link = std::make_shared<MouseLink>();
    const auto device = opened(link);
    DeviceSample sample;
    link->setPointer({.position = {1.0, -1.0, 0.0}});
    ASSERT_EQ(device->read(sample), DeviceStatus::Fine);
    EXPECT_EQ(sample.position.x, MouseDevice::workspace().high.x);
    EXPECT_EQ(sample.position.y, MouseDevice::workspace().low.y);
    link->setPointer({.position = {std::nan(""), 0.0, 0.0}});
    link->setPointer({.position = {}, .twist_rad = INFINITY});
    ASSERT_EQ(device->read(sample), DeviceStatus::Fine);
    EXPECT_EQ(sample.position.x, MouseDevice::workspace().high.x) << "as before";
}

TEST(MouseDevice, ShowsTheForceUntilItIsClosed)
{
    const auto link = std::make_shared<MouseLink>();
    auto device = opened(link);
    EXPECT_EQ(device->write({0.0, 1.0, -2.0}), DeviceStatus::Fine);
    EXPECT_EQ(link->forceN(), (Vec3{0.0, 1.0, -2.0}));
    EXPECT_EQ(device->write({33.0, 0.0, 0.0}), DeviceStatus::Fine);
    EXPECT_NEAR(link->forceN().x, device->capabilities().force_n_peak, 1e-12);
    EXPECT_EQ(device->write({std::nan(""), 0.0, 0.0}), DeviceStatus::Fine);
    EXPECT_EQ(link->forceN(), Vec3{});
    EXPECT_EQ(device->write({1.0, 0.0, 0.0}), DeviceStatus::Fine);
    device.reset();
    EXPECT_EQ(link->forceN(), Vec3{});
}

TEST(MouseDevice, NeverShowsHalfOfAPosition)
{
    const auto link = std::make_shared<MouseLink>();
    const auto device = opened(link);
    constexpr int kMoves = 20'000;
    std::atomic<bool> is_over{false};
    std::thread window([&] {
        for (int i = 1; i <= kMoves; ++i) {
            const double at = 0.05 * i / kMoves;
            link->setPointer({.position = {at, at, at}, .buttons = 1});
            (void)link->forceN();
        }
        is_over = true;
    });
    double last = 0.0;
    while (!is_over) {
        DeviceSample sample;
        ASSERT_EQ(device->read(sample), DeviceStatus::Fine);
        ASSERT_EQ(sample.position.x, sample.position.y);
        ASSERT_EQ(sample.position.x, sample.position.z);
        ASSERT_GE(sample.position.x, last);
        last = sample.position.x;
        (void)device->write({last, last, last});
    }
    window.join();
    DeviceSample sample;
    (void)device->read(sample);
    EXPECT_EQ(sample.position.x, 0.05);
}

TEST(MouseDriver, OpensOneDeviceForAWindow)
{
    const auto link = std::make_shared<MouseLink>();
    MouseDriver driver(link);
    ASSERT_EQ(driver.find().size(), 1U);
    EXPECT_TRUE(driver.find()[0].isUsable());
    auto device = opened(link);
    EXPECT_EQ(driver.open("").error().message, "mouse:: is already in use; close it there first");
    device.reset();
    EXPECT_TRUE(driver.open(""));
    EXPECT_EQ(driver.open("x").error().code, ErrorCode::Invalid);
}

TEST(MouseDriver, SaysThatThereIsNoWindow)
{
    MouseDriver driver(nullptr);
    EXPECT_EQ(driver.find()[0].reason,
              "the mouse device needs the program's window, which is not open");
    EXPECT_EQ(driver.open("").error().code, ErrorCode::NotFound);
}

} // namespace marsview::test
