#include "tests/ui/hand_window.h"
#include "ui/controllers/connection_mark.h"

#include <QFile>
#include <QSettings>
#include <QTest>

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

namespace marsview {
namespace {

QString markKey()
{
    return QStringLiteral("haptics/connectedBy");
}

// The id of a process that has ended.
qint64 endedProcess()
{
    const pid_t child = fork();
    if (child == 0) {
        _exit(0);
    }
    waitpid(child, nullptr, 0);
    return child;
}

class ConnectionMarkTest : public HandWindowTest {
protected:
    void SetUp() override
    {
        QSettings().remove(QStringLiteral("haptics"));
        QSettings().setValue(QStringLiteral("haptics/device"), QStringLiteral("hand:"));
    }
    void TearDown() override
    {
        window_.reset();
        QSettings().remove(QStringLiteral("haptics"));
    }

    void makeWindow() { HandWindowTest::makeWindow(kSmall, WindowOptions::Geometry::Remembered); }
};

TEST_F(ConnectionMarkTest, ADeviceIsNotConnectedByItselfAfterTheProgramEndedWithIt)
{
    QSettings().setValue(markKey(), endedProcess());
    makeWindow();
    EXPECT_EQ(haptics().connection(), HapticsConnection::None);
    EXPECT_TRUE(haptics().notice().contains(QStringLiteral("ended unexpectedly while hand:")))
        << haptics().notice().toStdString();
    EXPECT_FALSE(QSettings().contains(markKey()));
    // An explicit request connects all the same.
    haptics().connectTo(QStringLiteral("hand:"));
    EXPECT_TRUE(isConnectedSoon());
}

TEST_F(ConnectionMarkTest, IsThereAsLongAsADeviceIsConnected)
{
    makeWindow();
    ASSERT_TRUE(isConnectedSoon());
    EXPECT_EQ(QSettings().value(markKey()).toLongLong(), QCoreApplication::applicationPid());
    window_.reset();
    EXPECT_FALSE(QSettings().contains(markKey()));
    EXPECT_EQ(QSettings().value(QStringLiteral("haptics/device")).toString(),
              QStringLiteral("hand:"));
    makeWindow();
    EXPECT_TRUE(isConnectedSoon());
}

TEST_F(ConnectionMarkTest, ARecordingThatIsReplayedIsNoDevice)
{
    makeWindow();
    ASSERT_TRUE(isConnectedSoon());
    const QString file = maps_.path(QStringLiteral("goals.csv"));
    QFile text(file);
    ASSERT_TRUE(text.open(QIODevice::WriteOnly));
    text.write("x,y,z\n500900,4000600,5000\n");
    text.close();
    ASSERT_TRUE(connectTo(QStringLiteral("replay:") + file));
    EXPECT_FALSE(QSettings().contains(markKey()));
}

TEST_F(ConnectionMarkTest, AnotherProgramThatRunsIsNotTakenForOneThatEnded)
{
    QSettings().setValue(markKey(), static_cast<qint64>(getppid()));
    EXPECT_FALSE(ConnectionMark::takeLeft());
    EXPECT_TRUE(QSettings().contains(markKey()));
}

} // namespace
} // namespace marsview
