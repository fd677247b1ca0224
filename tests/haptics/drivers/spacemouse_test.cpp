#include "haptics/drivers/spacemouse/spacemouse.h"
#include "tests/haptics/drivers/fake_hid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>

namespace marsview::test {
namespace {

using testing::HasSubstr;

const FakeHidDevice kNavigator{"/dev/hidraw2", 0x046D, 0xC626, 0x01, 0x08};

} // namespace

TEST(SpaceMouseReport, TurnsTheirAxesIntoOurs)
{
    SpaceMouseRates rates;
    // 350 counts is full deflection. Right, toward the user, down.
    ASSERT_TRUE(takeSpaceMouseReport(reportOf({350, 175, -70}, 7, {1}), rates));
    EXPECT_EQ(rates.push, (Vec3{1.0, -0.5, 0.2}));
    ASSERT_TRUE(takeSpaceMouseReport(reportOf({-35, 700, 0}, 7, {2}), rates));
    EXPECT_EQ(rates.turn, (Vec3{-0.1, -1.0, 0.0}));
    EXPECT_EQ(rates.push, (Vec3{1.0, -0.5, 0.2})) << "stays";
    EXPECT_FALSE(rates.isAtRest());
    ASSERT_TRUE(takeSpaceMouseReport(FakeHid::Report{3, 0x05, 0x80}, rates));
    EXPECT_EQ(rates.buttons, 0x8005U);
}

TEST(SpaceMouseReport, TakesAllSixAxesFromOneReport)
{
    SpaceMouseRates rates;
    ASSERT_TRUE(takeSpaceMouseReport(reportOf({35, 0, 0, 0, 0, -175}, 13, {1}), rates));
    EXPECT_EQ(rates.push, (Vec3{0.1, 0.0, 0.0}));
    EXPECT_EQ(rates.turn, (Vec3{0.0, 0.0, 0.5}));
    // Also if a receiver pads its reports.
    ASSERT_TRUE(takeSpaceMouseReport(reportOf({0, 0, 0, 0, 0, 0}, 32, {1}), rates));
    EXPECT_TRUE(rates.isAtRest());
}

TEST(SpaceMouseReport, LeavesTheRatesAloneWhereAReportIsShortOrUnknown)
{
    const SpaceMouseRates before{.push = {0.1, 0.2, 0.3}, .turn = {0.4, 0.5, 0.6}, .buttons = 7};
    for (const FakeHid::Report& report : {FakeHid::Report{},
                                          {1},
                                          reportOf({1, 2}, 6, {1}),
                                          reportOf({1, 2}, 5, {2}),
                                          {3},
                                          reportOf({1, 2, 3}, 7, {23})}) {
        SpaceMouseRates rates = before;
        EXPECT_FALSE(takeSpaceMouseReport(report, rates));
        EXPECT_EQ(rates.push, before.push);
        EXPECT_EQ(rates.turn, before.turn);
        EXPECT_EQ(rates.buttons, before.buttons);
    }
}

TEST(SpaceMouse, IsFoundAmongMiceAndKeyboardsOfItsMaker)
{
    FakeHid hid;
    hid.plugIn({"/dev/hidraw0", 0x046D, 0xC077, 0x01, 0x02}); // a mouse by Logitech
    hid.plugIn({"/dev/hidraw1", 0x256F, 0xC650, 0x01, 0x02}); // CadMouse
    hid.plugIn({"/dev/hidraw3", 0x256F, 0xC664, 0x01, 0x06}); // keyboard
    hid.plugIn({"/dev/hidraw4", 0x256F, 0xC652, 0x01, 0x02}); // the mouse of a receiver
    hid.plugIn({"/dev/hidraw5", 0x256F, 0xC652, 0x01, 0x08}); // and its cap
    hid.plugIn(kNavigator);
    const std::vector<FoundDevice> found = SpaceMouse::find(hid.api());
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].uri, "spacemouse:/dev/hidraw5");
    EXPECT_EQ(found[1].uri, "spacemouse:/dev/hidraw2");
    EXPECT_EQ(found[1].name, "SpaceNavigator");
    EXPECT_TRUE(found[1].isUsable());
}

TEST(SpaceMouse, TellsTheNewestRatesUntilItIsUnplugged)
{
    FakeHid hid;
    hid.plugIn(kNavigator);
    hid.sayOnce(reportOf({0, -350, 0}, 7, {1}));
    hid.sayOnce(reportOf({0, 0, 350}, 7, {2}));
    hid.say({3, 1});
    auto mouse = SpaceMouse::open("/dev/hidraw2", hid.api());
    ASSERT_TRUE(mouse) << mouse.error().message;
    EXPECT_EQ((*mouse)->name(), "SpaceNavigator");
    EXPECT_TRUE(hid.waitUntil([&] { return (*mouse)->rates().buttons == 1; }));
    EXPECT_EQ((*mouse)->rates().push, (Vec3{0.0, 1.0, 0.0}));
    EXPECT_EQ((*mouse)->rates().turn, (Vec3{0.0, 0.0, -1.0}));
    EXPECT_FALSE((*mouse)->isLost());
    hid.unplug();
    EXPECT_TRUE(hid.waitUntil([&] { return (*mouse)->isLost(); }));
    EXPECT_TRUE((*mouse)->rates().isAtRest()) << "the camera stops";
    mouse->reset();
    EXPECT_EQ(hid.openDevices(), 0U);
}

TEST(SpaceMouse, ComesToRestWhenItFallsSilentWhilePushed)
{
    FakeHid hid;
    hid.plugIn(kNavigator);
    hid.sayOnce(reportOf({350, 0, 0}, 7, {1}));
    auto mouse = SpaceMouse::open("", hid.api());
    ASSERT_TRUE(mouse) << mouse.error().message;
    EXPECT_TRUE(hid.waitUntil([&] { return !(*mouse)->rates().isAtRest(); }));
    EXPECT_TRUE(hid.waitUntil([&] { return (*mouse)->rates().isAtRest(); }));
    EXPECT_FALSE((*mouse)->isLost());
    hid.say(reportOf({-350, 0, 0}, 7, {1}));
    EXPECT_TRUE(hid.waitUntil([&] { return (*mouse)->rates().push.x == -1.0; }));
}

// A client that sleeps while the cap is at rest is notified of everything relevant, and of nothing
// else.
TEST(SpaceMouse, NotifiesWhenItLeavesItsRestWhenAButtonGoesDownAndWhenItIsLost)
{
    FakeHid hid;
    hid.plugIn(kNavigator);
    hid.say(reportOf({0, 0, 0}, 7, {1}));
    std::atomic<int> notified{0};
    auto mouse = SpaceMouse::open("", hid.api(), [&] { ++notified; });
    ASSERT_TRUE(mouse) << mouse.error().message;
    const auto take_turns = [&](int count) {
        EXPECT_TRUE(hid.waitUntil([&] { return count-- < 0; }));
    };
    take_turns(20);
    EXPECT_EQ(notified, 0);
    hid.say(reportOf({35, 0, 0}, 7, {1}));
    EXPECT_TRUE(hid.waitUntil([&] { return notified == 1; }));
    hid.say(reportOf({70, 0, 0}, 7, {1}));
    take_turns(20);
    EXPECT_EQ(notified, 1) << "it was already deflected";
    hid.say(reportOf({0, 0, 0}, 7, {1}));
    EXPECT_TRUE(hid.waitUntil([&] { return (*mouse)->rates().isAtRest(); }));
    hid.sayOnce({3, 1});
    hid.sayOnce({3, 0}); // released before the next look
    EXPECT_TRUE(hid.waitUntil([&] { return notified == 2; }));
    take_turns(20);
    EXPECT_EQ((*mouse)->takePressed(), 1U);
    EXPECT_EQ((*mouse)->takePressed(), 0U) << "reported once";
    EXPECT_EQ(notified, 2);
    hid.unplug();
    EXPECT_TRUE(hid.waitUntil([&] { return notified == 3; }));
    EXPECT_TRUE((*mouse)->isLost());
}

TEST(SpaceMouse, SaysWhatItCannotOpen)
{
    FakeHid hid;
    EXPECT_THAT(SpaceMouse::open("", hid.api()).error().message,
                HasSubstr("spacemouse:: no SpaceMouse is connected there"));
    FakeHidDevice locked = kNavigator;
    locked.access_error = EACCES;
    hid.plugIn(locked);
    EXPECT_THAT(SpaceMouse::open("", hid.api()).error().message,
                HasSubstr("no permission to open /dev/hidraw2"));
}

TEST(SpaceMouseDriver, ListsItAndSaysThatItCannotTouch)
{
    FakeHid hid;
    hid.plugIn(kNavigator);
    SpaceMouseDriver driver(hid.api());
    const std::vector<FoundDevice> found = driver.find();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_THAT(found[0].reason, HasSubstr("moves the camera"));
    EXPECT_THAT(found[0].reason, HasSubstr("not a haptic device"));
    EXPECT_THAT(driver.open("/dev/hidraw2").error().message,
                testing::StartsWith("spacemouse:/dev/hidraw2: a SpaceMouse moves the camera"));
}

} // namespace marsview::test
