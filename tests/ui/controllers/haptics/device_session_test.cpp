// Devices in a real window: opened, lost, awaited, and replaced by recordings.
#include "tests/ui/controllers/haptics/touched_hill.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"

#include <QDeadlineTimer>
#include <QSettings>
#include <QSignalSpy>
#include <QTest>
#include <QThread>

#include <gtest/gtest.h>

namespace marsview {
namespace {

class DeviceSessionTest : public TouchedHillTest {};

TEST_F(DeviceSessionTest, ADeviceThatCannotBeOpenedSaysWhy)
{
    device().connectTo(QStringLiteral("gone:locked"));
    EXPECT_EQ(device().connection(), HapticsConnection::Opening);
    ASSERT_TRUE(waitFor([&] { return device().connection() == HapticsConnection::None; }));
    EXPECT_TRUE(device().problem().contains(QStringLiteral("may not be opened")));
    EXPECT_EQ(haptics().settings().device, QString());
    ASSERT_TRUE(connectTo(QStringLiteral("sim:")));
    EXPECT_EQ(device().problem(), QString());
}

TEST_F(DeviceSessionTest, OpeningHoldsNothingUpAndCanBeCanceled)
{
    hand_->is_held_up = true;
    device().connectTo(QStringLiteral("hand:"));
    EXPECT_EQ(device().connection(), HapticsConnection::Opening);
    OrbitCamera camera = view().camera();
    camera.distance_m *= 0.5;
    view().setCamera(camera); // the window continues
    device().disconnectDevice();
    EXPECT_EQ(device().connection(), HapticsConnection::None);
    hand_->is_held_up = false;
    // A device that opens too late is closed, and never connected.
    ASSERT_TRUE(connectTo(QStringLiteral("sim:")));
    EXPECT_TRUE(waitFor([&] { return hand_->open_count == 0; }));
    EXPECT_EQ(device().uri(), QStringLiteral("sim:"));
}

TEST_F(DeviceSessionTest, ALostDeviceIsToldAndEverythingElseGoesOn)
{
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    ASSERT_TRUE(pressDown());
    hand_->is_lost = true;
    ASSERT_TRUE(waitFor([&] { return device().connection() == HapticsConnection::None; }));
    EXPECT_TRUE(device().problem().contains(QStringLiteral("Test hand")));
    EXPECT_TRUE(device().problem().contains(QStringLiteral("The plug was pulled")));
    EXPECT_EQ(hand_->open_count, 0);
    EXPECT_FALSE(view().shownStylus());
    EXPECT_TRUE(openAndWait(*window_, maps_.ring()));
}

TEST_F(DeviceSessionTest, ALostDeviceThatIsThereAgainIsConnectedAnew)
{
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    ASSERT_TRUE(waitFor([&] { return state().tick > 10; }));
    hand_->is_lost = true;
    hand_->is_there = false;
    ASSERT_TRUE(waitFor([&] { return device().connection() == HapticsConnection::None; }));
    const auto look = [&] {
        device().findDevices();
        return waitFor([&] { return !device().isFinding(); });
    };
    ASSERT_TRUE(look());
    EXPECT_EQ(device().connection(), HapticsConnection::None);
    EXPECT_EQ(device().state(), DeviceState::LostAndGone);
    // The panel is hidden; the search for the device continues all the same.
    hand_->is_lost = false;
    hand_->is_there = true;
    EXPECT_TRUE(QTest::qWaitFor(
        [&] { return device().connection() == HapticsConnection::Connected; }, kTimeout));
    EXPECT_EQ(device().state(), DeviceState::Reconnected);
    EXPECT_TRUE(device().isLost()) << "its diagnostic log begins before the loss";
}

TEST_F(DeviceSessionTest, ALostDeviceThatRefusesIsNotAwaitedAndKeepsItsDiagnosticLog)
{
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    ASSERT_TRUE(waitFor([&] { return state().tick > 10; }));
    hand_->is_lost = true;
    hand_->is_there = false;
    ASSERT_TRUE(waitFor([&] { return device().connection() == HapticsConnection::None; }));
    EXPECT_TRUE(device().canBeStopped());
    device().connectTo(QStringLiteral("hand:")); // by the user
    EXPECT_EQ(device().state(), DeviceState::Reopening);
    ASSERT_TRUE(waitFor([&] { return device().connection() == HapticsConnection::None; }));
    EXPECT_EQ(device().state(), DeviceState::LostAndRefused);
    EXPECT_TRUE(device().isLost());
    EXPECT_TRUE(device().hasTicks());
    EXPECT_NE(device().notice(), QString());
    EXPECT_FALSE(device().canBeStopped());
}

TEST_F(DeviceSessionTest, AReplayThatEndsWhileStoppedIsNotLost)
{
    const QString file = maps_.path(QStringLiteral("short.csv"));
    writeGoals(file, 400, "500900,4000600,5000");
    ASSERT_TRUE(connectTo(QStringLiteral("replay:") + file));
    haptics().setStopped(true);
    ASSERT_TRUE(waitFor([&] { return device().connection() == HapticsConnection::None; }));
    EXPECT_EQ(device().problem(), QString());
    EXPECT_EQ(device().replayedToItsEnd(), file);
    EXPECT_FALSE(device().isLost());
    EXPECT_FALSE(device().canBeStopped()); // the program is not waiting for anything
    haptics().setStopped(false);
}

// As when the camera flies after the hand in the moment in which the recording ends.
TEST_F(DeviceSessionTest, AReplayEndsThoughTheCameraMovesAsItDoes)
{
    const QString file = maps_.path(QStringLiteral("short.csv"));
    writeGoals(file, 400, "500900,4000600,5000");
    ASSERT_TRUE(connectTo(QStringLiteral("replay:") + file));
    ASSERT_TRUE(waitFor([&] { return state().tick > 0; }));
    const QDeadlineTimer deadline(kTimeout);
    while (!device().loop()->hasEnded() && !deadline.hasExpired()) {
        QThread::msleep(1); // without events: nothing is polled
    }
    ASSERT_TRUE(device().loop()->hasEnded());
    OrbitCamera camera = view().camera();
    camera.distance_m *= 0.9;
    view().setCamera(camera);
    EXPECT_TRUE(waitFor([&] { return device().connection() == HapticsConnection::None; }));
    EXPECT_EQ(device().replayedToItsEnd(), file);
    device().replayAgain();
    EXPECT_TRUE(isConnectedSoon());
    EXPECT_TRUE(device().isReplaying());
}

// Also if it was unplugged in the meantime.
TEST_F(DeviceSessionTest, ADeviceThatIsGoneAfterAReplayIsConnectedWhenItIsThere)
{
    const QString file = maps_.path(QStringLiteral("touch.csv"));
    writeGoals(file, 1000, "500900,4000600,5000");
    for (const bool is_lost_before : {true, false}) {
        ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
        hand_->is_there = false;
        if (is_lost_before) {
            hand_->is_lost = true;
            ASSERT_TRUE(waitFor([&] { return device().isLost(); }));
        }
        ASSERT_TRUE(connectTo(QStringLiteral("replay:") + file));
        ASSERT_TRUE(waitFor([&] { return device().connection() == HapticsConnection::None; }));
        hand_->is_lost = false;
        hand_->is_there = true;
        EXPECT_TRUE(waitFor([&] { return device().loop() != nullptr; })) << is_lost_before;
        EXPECT_EQ(device().uri(), QStringLiteral("hand:"));
        device().disconnectDevice();
    }
}

TEST_F(DeviceSessionTest, NothingRunsWhileNothingIsConnected)
{
    EXPECT_EQ(device().loop(), nullptr);
    QSignalSpy polled(&device(), &DeviceSession::polled);
    QTest::qWait(200);
    EXPECT_EQ(polled.count(), 0);
    EXPECT_FALSE(device().isFinding());
}

TEST_F(DeviceSessionTest, ARememberedDeviceThatIsNotThereBothersNobody)
{
    QSettings().setValue(QStringLiteral("haptics/device"), QStringLiteral("gone:"));
    makeWindow(kSmall, WindowOptions::Geometry::Remembered);
    EXPECT_EQ(device().connection(), HapticsConnection::Opening);
    ASSERT_TRUE(waitFor([&] { return device().connection() == HapticsConnection::None; }));
    EXPECT_NE(device().problem(), QString()); // shown in the panel
    EXPECT_EQ(device().notice(), QString());
    EXPECT_EQ(haptics().settings().device, QStringLiteral("gone:"));
    device().connectTo(QStringLiteral("gone:"));
    ASSERT_TRUE(waitFor([&] { return device().connection() == HapticsConnection::None; }));
    EXPECT_NE(device().notice(), QString());
    QSettings().remove(QStringLiteral("haptics"));
}

TEST_F(DeviceSessionTest, ARememberedDeviceThatIsThereAndRefusesIsToldOf)
{
    QSettings().setValue(QStringLiteral("haptics/device"), QStringLiteral("gone:locked"));
    makeWindow(kSmall, WindowOptions::Geometry::Remembered);
    ASSERT_TRUE(waitFor([&] { return device().connection() == HapticsConnection::None; }));
    EXPECT_TRUE(device().notice().contains(QStringLiteral("may not be opened")));
    QSettings().remove(QStringLiteral("haptics"));
}

} // namespace
} // namespace marsview
