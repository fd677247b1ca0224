// After a crash with a device, the next start does not connect it by itself.
#include "haptics/device/crash_marker.h"
#include "tests/support/temp_folder.h"
#include "tests/ui/hand_window.h"

#include <QFile>
#include <QSettings>
#include <QTest>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

namespace marsview {
namespace {

// The number of a process that is no more.
pid_t endedProcess()
{
    const pid_t child = fork();
    if (child == 0) {
        _exit(0);
    }
    waitpid(child, nullptr, 0);
    return child;
}

class ConnectionMarker : public HandWindowTest {
protected:
    void SetUp() override
    {
        setenv("XDG_STATE_HOME", state_.path().c_str(), 1);
        QSettings().remove(QStringLiteral("haptics"));
        QSettings().setValue(QStringLiteral("haptics/device"), QStringLiteral("hand:"));
    }
    void TearDown() override
    {
        window_.reset();
        QSettings().remove(QStringLiteral("haptics"));
        unsetenv("XDG_STATE_HOME");
    }

    void makeWindow() { HandWindowTest::makeWindow(kSmall, WindowOptions::Geometry::Remembered); }
    static std::size_t markers()
    {
        std::error_code none;
        std::size_t count = 0;
        for (const auto& entry :
             std::filesystem::directory_iterator(CrashMarker::defaultFolder(), none)) {
            count += entry.path().filename().string().starts_with("window.connected") ? 1U : 0U;
        }
        return count;
    }

    test::TempFolder state_;
};

TEST_F(ConnectionMarker, PreventsReconnectionAfterACrashWithTheDevice)
{
    std::filesystem::create_directories(CrashMarker::defaultFolder());
    const pid_t ended = endedProcess();
    std::ofstream(CrashMarker::defaultFolder() /
                  ("window.connected-" + std::to_string(ended) + "-0.loading"))
        << ended << '\n';
    makeWindow();
    EXPECT_EQ(device().connection(), HapticsConnection::None);
    EXPECT_TRUE(device().notice().contains(QStringLiteral("ended unexpectedly while hand:")))
        << device().notice().toStdString();
    EXPECT_EQ(markers(), 0U);
    // On request it is connected.
    device().connectTo(QStringLiteral("hand:"));
    EXPECT_TRUE(isConnectedSoon());
}

TEST_F(ConnectionMarker, ExistsAsLongAsADeviceIsConnected)
{
    makeWindow();
    ASSERT_TRUE(isConnectedSoon());
    EXPECT_EQ(markers(), 1U);
    window_.reset();
    EXPECT_EQ(markers(), 0U);
    EXPECT_EQ(QSettings().value(QStringLiteral("haptics/device")).toString(),
              QStringLiteral("hand:"));
    makeWindow();
    EXPECT_TRUE(isConnectedSoon());
}

TEST_F(ConnectionMarker, LeavesTheDeviceIfPreferencesSaySo)
{
    QSettings().setValue(QStringLiteral("preferences/reconnectsDevice"), false);
    makeWindow();
    EXPECT_EQ(device().connection(), HapticsConnection::None);
    EXPECT_EQ(haptics().settings().device, QStringLiteral("hand:")) << "still remembered";
    QSettings().remove(QStringLiteral("preferences"));
}

// 2026-11: the simulated hand stroked the map at the next start.
TEST_F(ConnectionMarker, LeavesTheSimulatedHand)
{
    QSettings().setValue(QStringLiteral("haptics/device"), QStringLiteral("sim:"));
    makeWindow();
    EXPECT_EQ(device().connection(), HapticsConnection::None);
    EXPECT_EQ(device().notice(), QString());
}

TEST_F(ConnectionMarker, IsNotSetForARecordingThatIsReplayed)
{
    makeWindow();
    ASSERT_TRUE(isConnectedSoon());
    const QString file = maps_.path(QStringLiteral("goals.csv"));
    QFile text(file);
    ASSERT_TRUE(text.open(QIODevice::WriteOnly));
    text.write("x,y,z\n500900,4000600,5000\n");
    text.close();
    ASSERT_TRUE(connectTo(QStringLiteral("replay:") + file));
    EXPECT_EQ(markers(), 0U);
}

TEST_F(ConnectionMarker, OfARunningProgramIsNotTakenForACrash)
{
    const CrashMarker running = CrashMarker::set(CrashMarker::defaultFolder(), "window.connected");
    makeWindow();
    EXPECT_TRUE(isConnectedSoon());
    EXPECT_EQ(markers(), 2U);
}

} // namespace
} // namespace marsview
