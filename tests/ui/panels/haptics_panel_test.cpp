#include "tests/ui/hand_window.h"
#include "ui/overlay/force_meter.h"
#include "ui/panels/haptics_panel.h"
#include "ui/panels/limit_slider.h"
#include "ui/panels/time_plot.h"
#include "ui/widgets/notice_bar.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"

#include <QActionGroup>
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QFile>
#include <QLabel>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QSlider>
#include <QTest>
#include <QToolButton>

#include <gtest/gtest.h>

namespace marsview {
namespace {

class HapticsPanelTest : public HandWindowTest {
protected:
    void SetUp() override
    {
        makeWindow(kWithPanels);
        ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
        window_->actionSet().haptic_devices->trigger();
        ASSERT_TRUE(waitFor([&] { return list().count() == 3; }));
    }

    HapticsPanel& panel() { return *window_->hapticsPanel(); }
    QListWidget& list() { return *panel().list(); }
    template <typename T>
    T& part(const char* name)
    {
        return *panel().findChild<T*>(QLatin1String(name));
    }
    QString text(const char* name) { return part<QLabel>(name).text(); }
    // Goals below the surface.
    static void writeGoals(const QString& file, int count)
    {
        QFile goals(file);
        ASSERT_TRUE(goals.open(QIODevice::WriteOnly));
        goals.write("x,y,z\n" + QByteArray("500900,4000600,0\n").repeated(count));
    }
    bool connectByKeys(int row)
    {
        list().setFocus();
        list().setCurrentRow(row);
        QTest::keyClick(&list(), Qt::Key_Return);
        return waitFor([&] { return device().connection() == HapticsConnection::Connected; });
    }
};

TEST_F(HapticsPanelTest, ListsDevicesWithTheReasonWhyNot)
{
    EXPECT_TRUE(window_->docks()->haptics()->isVisible());
    EXPECT_TRUE(list().hasFocus());
    EXPECT_EQ(list().item(0)->text(), QStringLiteral("Test hand"));
    EXPECT_EQ(list().item(2)->text(), QStringLiteral("Arm"));
    EXPECT_TRUE(list()
                    .item(2)
                    ->data(Qt::AccessibleTextRole)
                    .toString()
                    .contains(QStringLiteral("May not be opened")));
    EXPECT_EQ(text("hapticStatus"), QStringLiteral("No device is connected."));
    EXPECT_EQ(list().item(1)->text(), QStringLiteral("Simulated hand"));
    auto& connect = part<QPushButton>("connectDevice");
    EXPECT_TRUE(connect.isEnabled());
    list().setCurrentRow(2);
    EXPECT_FALSE(connect.isEnabled());
    EXPECT_TRUE(text("hapticStatus").startsWith(QStringLiteral("May not be opened")));
    QTest::keyClick(&list(), Qt::Key_Return);
    EXPECT_EQ(device().connection(), HapticsConnection::None);
    for (int i = 0; i < list().count(); ++i) { // at a glance, without scrolling
        EXPECT_TRUE(list().viewport()->rect().contains(list().visualItemRect(list().item(i)))) << i;
    }
}

TEST_F(HapticsPanelTest, HasNoMetersWithoutADevice)
{
    const auto& force = part<QProgressBar>("force");
    const auto& plot = *panel().findChild<TimePlot*>();
    EXPECT_FALSE(force.isVisible());
    EXPECT_FALSE(plot.isVisible());
    ASSERT_TRUE(connectByKeys(1));
    EXPECT_TRUE(force.isVisible());
    EXPECT_TRUE(plot.isVisible());
    part<QPushButton>("connectDevice").click();
    EXPECT_FALSE(force.isVisible());
}

TEST_F(HapticsPanelTest, ShowsForceAndTimesWhileConnected)
{
    ASSERT_TRUE(connectByKeys(1));
    EXPECT_TRUE(text("hapticStatus").startsWith(QStringLiteral("Simulated hand")));
    EXPECT_TRUE(list().item(1)->font().bold());
    EXPECT_FALSE(list().item(0)->font().bold());
    auto& force = part<QProgressBar>("force");
    EXPECT_TRUE(waitFor([&] { return force.value() > 10; }));
    EXPECT_EQ(text("forceOffReason"), QStringLiteral("Touching the terrain"));
    // The meter over the map says the same.
    auto* meter = window_->findChild<ForceMeter*>();
    EXPECT_TRUE(waitFor([&] {
        return meter->text() == force.format() && meter->text() != QStringLiteral("0.00 N");
    }));
    EXPECT_TRUE(waitFor([&] {
        return panel().findChild<TimePlot*>()->moments().size() > 2 && !text("times").isEmpty();
    }));
    EXPECT_TRUE(text("times").contains(QStringLiteral("µs")));
    for (const char* label : {"median", "99.9", "longest"}) {
        EXPECT_TRUE(text("times").contains(QLatin1String(label))) << label;
    }
    EXPECT_TRUE(text("realTime").contains(QStringLiteral("Real-time scheduling")));
    part<QPushButton>("connectDevice").click();
    EXPECT_EQ(device().connection(), HapticsConnection::None);
    EXPECT_EQ(force.value(), 0);
    EXPECT_EQ(panel().findChild<TimePlot*>()->moments().size(), 0U);
}

TEST_F(HapticsPanelTest, TheStopButtonStopsAndLetsReturn)
{
    ASSERT_TRUE(connectByKeys(0));
    hand_->moveTo({0.0, 0.0, -0.055});
    ASSERT_TRUE(waitFor([&] { return hand_->force_n > 0.5; }));
    auto& stop = part<QPushButton>("emergencyStop");
    const QString before = stop.text();
    stop.setFocus();
    QTest::keyClick(&stop, Qt::Key_Space);
    EXPECT_TRUE(haptics().isStopped());
    EXPECT_NE(stop.text(), before);
    ASSERT_TRUE(waitFor([&] { return hand_->force_n == 0.0; }));
    EXPECT_TRUE(
        waitFor([&] { return text("forceOffReason").contains(QStringLiteral("emergency")); }));
    stop.click();
    EXPECT_FALSE(haptics().isStopped());
    EXPECT_TRUE(waitFor([&] { return hand_->force_n > 0.5; }));
}

TEST_F(HapticsPanelTest, ShowsAReplaysProgressAndStopsIt)
{
    const QString file = maps_.path(QStringLiteral("touch.csv"));
    writeGoals(file, 60'000);
    auto& progress = part<QProgressBar>("replayProgress");
    auto& replay = part<QPushButton>("replay");
    EXPECT_TRUE(progress.isHidden());
    const QString before = replay.text();
    device().connectTo(QStringLiteral("replay:") + file);
    ASSERT_TRUE(isConnectedSoon());
    EXPECT_TRUE(progress.isVisibleTo(&panel()));
    EXPECT_TRUE(waitFor([&] { return progress.value() > 0; }));
    EXPECT_TRUE(waitFor([&] { return state().contact.is_in_contact; }));
    EXPECT_TRUE(waitFor([&] { return text("forceOffReason") == QStringLiteral("Replaying"); }));
    // A list of goals has no forces.
    EXPECT_EQ(part<QProgressBar>("force").format(), QStringLiteral("No force recorded"));
    EXPECT_EQ(window_->findChild<ForceMeter*>()->sizeHint(), QSize(0, 0)) << "not in use";
    EXPECT_EQ(text("hapticStatus"), QStringLiteral("Replaying touch.csv"));
    EXPECT_EQ(replay.text(), QStringLiteral("Stop Re&play"));
    auto& stop = part<QPushButton>("emergencyStop");
    EXPECT_TRUE(stop.isEnabled());
    stop.click();
    EXPECT_TRUE(haptics().isStopped());
    EXPECT_TRUE(
        waitFor([&] { return text("forceOffReason").contains(QStringLiteral("emergency")); }));
    stop.click();
    EXPECT_TRUE(waitFor([&] { return text("forceOffReason") == QStringLiteral("Replaying"); }));
    replay.click();
    EXPECT_EQ(device().connection(), HapticsConnection::None);
    EXPECT_TRUE(progress.isHidden());
    EXPECT_EQ(replay.text(), before);
}

TEST_F(HapticsPanelTest, SaysThatAReplayHasEndedAndOffersItAgain)
{
    const QString file = maps_.path(QStringLiteral("touch.csv"));
    writeGoals(file, 1500);
    ASSERT_TRUE(connectByKeys(0));
    QStringList states;
    QObject::connect(&device(), &DeviceSession::polled, &panel(),
                     [&] { states.append(text("forceOffReason")); });
    device().connectTo(QStringLiteral("replay:") + file);
    // The device comes back by itself, and what has ended is said until it is closed.
    ASSERT_TRUE(waitFor([&] { return !device().replayedToItsEnd().isEmpty(); }));
    ASSERT_TRUE(waitFor([&] { return device().loop() != nullptr; }));
    EXPECT_EQ(device().uri(), QStringLiteral("hand:"));
    const QString ended = QStringLiteral("touch.csv was replayed to its end");
    EXPECT_EQ(text("recording"), ended);
    const auto& bar = *window_->findChild<NoticeBar*>();
    const auto* notice = bar.findChild<QLabel*>(QStringLiteral("noticeText"));
    auto* again = bar.findChild<QToolButton*>(QStringLiteral("noticeAction"));
    EXPECT_EQ(notice->text(), ended);
    EXPECT_EQ(again->text(), QStringLiteral("Replay Again"));
    again->click();
    EXPECT_TRUE(waitFor([&] { return device().isReplaying(); }));
    EXPECT_NE(notice->text(), ended);
    EXPECT_TRUE(states.filter(QStringLiteral("no layer")).isEmpty())
        << states.join(QLatin1Char('|')).toStdString();
}

TEST_F(HapticsPanelTest, TheStiffnessStaysAsChosenAndTheDevicesLimitIsMarked)
{
    auto& stiffness = part<LimitSlider>("stiffness");
    stiffness.setValue(150);
    ASSERT_EQ(haptics().settings().stiffness_n_per_m, 1500.0);
    EXPECT_FALSE(stiffness.limit());
    EXPECT_TRUE(part<QLabel>("stiffnessLimit").isHidden());
    ASSERT_TRUE(connectByKeys(0)); // stands 400 N/m
    EXPECT_EQ(stiffness.value(), 150);
    EXPECT_EQ(stiffness.maximum(), 200);
    EXPECT_EQ(stiffness.limit(), 40);
    EXPECT_TRUE(part<QLabel>("stiffnessLimit").isVisible());
    EXPECT_EQ(text("stiffnessLimit"), QStringLiteral("Limited to 400 N/m"));
    stiffness.setFocus();
    QTest::keyClick(&stiffness, Qt::Key_Left);
    EXPECT_EQ(haptics().settings().stiffness_n_per_m, 1490.0);
    const int below = part<QSlider>("forceScale").y();
    stiffness.setValue(39);
    EXPECT_EQ(text("stiffnessLimit"), QStringLiteral("Device limit: 400 N/m"));
    QCoreApplication::processEvents();
    EXPECT_EQ(part<QSlider>("forceScale").y(), below) << "nothing moves";
    part<QSlider>("forceScale").setValue(10);
    EXPECT_EQ(haptics().settings().force_share, 0.5);
    part<QCheckBox>("walls").click();
    EXPECT_FALSE(haptics().settings().has_walls);
}

TEST_F(HapticsPanelTest, TheModelIsThatOfTheMenu)
{
    auto& models = part<QComboBox>("contactModel");
    models.setFocus();
    QTest::keyClick(&models, Qt::Key_Down);
    const ContactModelKind chosen = window_->preferences().contact_model;
    EXPECT_NE(chosen, kContactModelDefault);
    EXPECT_EQ(window_->view()->contactModel(), chosen);
    window_->actionSet().contact_model_group->actions().front()->trigger();
    EXPECT_EQ(models.currentIndex(), 0);
}

TEST_F(HapticsPanelTest, SaysWhyADeviceWasLost)
{
    ASSERT_TRUE(connectByKeys(0));
    hand_->is_lost = true;
    ASSERT_TRUE(waitFor([&] { return device().connection() == HapticsConnection::None; }));
    EXPECT_TRUE(text("hapticStatus").contains(QStringLiteral("The plug was pulled")));
}

TEST_F(HapticsPanelTest, RecordsOnlyWhatIsTouched)
{
    EXPECT_FALSE(part<QPushButton>("record").isEnabled());
    ASSERT_TRUE(connectByKeys(0));
    EXPECT_TRUE(part<QPushButton>("record").isEnabled());
    ASSERT_TRUE(haptics().recorder().start(maps_.path(QStringLiteral("touch.csv"))));
    EXPECT_EQ(text("recording"), QStringLiteral("Recording into touch.csv"));
    ASSERT_TRUE(waitFor([&] { return device().loop()->state().tick > 100; }));
    part<QPushButton>("record").click();
    EXPECT_FALSE(haptics().recorder().isRecording());
    EXPECT_TRUE(text("recording").contains(QStringLiteral("updates recorded")));
}

TEST_F(HapticsPanelTest, LooksForDevicesOnlyWhileItIsOpenAndNothingIsConnected)
{
    hand_->is_there = false;
    EXPECT_TRUE(waitFor([&] { return list().count() == 2; })); // detected as lost by itself
    ASSERT_TRUE(connectByKeys(0));
    hand_->is_there = true;
    QTest::qWait(200);
    EXPECT_FALSE(device().isFinding());
    EXPECT_EQ(list().count(), 2);
}

} // namespace
} // namespace marsview
