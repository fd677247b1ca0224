// The diagnostic log in a real window: of a working device, and of one that is gone.
#include "haptics/trace/session_recorder.h"
#include "tests/ui/hand_window.h"
#include "ui/canvas/terrain_view.h"
#include "ui/panels/haptics_panel.h"
#include "ui/widgets/notice_bar.h"
#include "ui/window/window_actions.h"

#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QStatusBar>
#include <QTest>
#include <QToolButton>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace marsview {
namespace {

// Indices of the columns in session_recorder.h.
constexpr qsizetype kTime = 3;
constexpr qsizetype kTick = 4;
constexpr qsizetype kForceZ = 11;
constexpr qsizetype kReason = 13;
constexpr qsizetype kMap = 14;

QByteArray lost()
{
    return QByteArray::fromStdString(std::string(forceOffReasonName(ForceOffReason::DeviceLost)));
}

class FlightRecordTest : public HandWindowTest {
protected:
    void SetUp() override
    {
        makeWindow(kWithPanels);
        ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    }

    QAction& action() { return *window_->actionSet().save_flight; }
    QPushButton& button()
    {
        return *window_->hapticsPanel()->findChild<QPushButton*>(QStringLiteral("saveFlight"));
    }
    QString panelText()
    {
        return window_->hapticsPanel()->findChild<QLabel*>(QStringLiteral("recording"))->text();
    }
    bool touch()
    {
        device().connectTo(QStringLiteral("hand:"));
        hand_->moveTo({0.0, 0.0, -0.055});
        return waitFor([&] { return hand_->force_n > 0.5; }) &&
               waitFor([&] { return device().loop()->state().tick > 300; });
    }
    bool lose()
    {
        hand_->is_lost = true;
        hand_->is_there = false;
        return waitFor([&] { return device().connection() == HapticsConnection::None; });
    }
    QFileDialog* dialog() { return window_->findChild<QFileDialog*>(); }
    // The rows that the open dialog saves, without the header.
    QList<QList<QByteArray>> saved(const QString& name)
    {
        const QString file = maps_.path(name);
        QSignalSpy spy(&haptics().recorder(), &TouchRecorder::ticksSaved);
        Q_EMIT dialog()->fileSelected(file);
        delete dialog();
        EXPECT_TRUE(waitFor([&] { return spy.count() == 1; }));
        QFile text(file);
        EXPECT_TRUE(text.open(QIODevice::ReadOnly));
        const QList<QByteArray> lines = text.readAll().trimmed().split('\n');
        EXPECT_EQ(lines[0].toStdString(),
                  std::string(kSessionColumns) + ",hand_x,hand_y,hand_z,tick_us,surface_z");
        QList<QList<QByteArray>> rows;
        for (const QByteArray& line : lines.sliced(1)) {
            rows.append(line.split(','));
        }
        return rows;
    }
};

TEST_F(FlightRecordTest, CoversTheTimeBeforeItIsSaved)
{
    EXPECT_FALSE(action().isEnabled());
    EXPECT_FALSE(button().isEnabled());
    ASSERT_TRUE(touch());
    ASSERT_TRUE(action().isEnabled());
    EXPECT_TRUE(button().isEnabled());
    const std::uint64_t before = device().loop()->state().tick;
    action().trigger();
    // A busy machine takes a while to open the dialog.
    const std::uint64_t asked = device().loop()->state().tick;
    ASSERT_NE(dialog(), nullptr);
    EXPECT_EQ(dialog()->directory(), QDir::home()); // not a folder of maps
    // The loop keeps running while a file name is chosen.
    ASSERT_TRUE(waitFor([&] { return device().loop()->state().tick > asked + 300; }));
    const auto rows = saved(QStringLiteral("flight.csv"));
    ASSERT_GT(rows.size(), 200);
    EXPECT_LE(rows.back()[kTick].toULongLong(), asked);
    EXPECT_GT(rows.back()[kTick].toULongLong() + 100, before);
    // The last moments, not a single tick: opening a dialog may delay the loop enough to switch the
    // force off.
    EXPECT_TRUE(std::any_of(rows.end() - 200, rows.end(), [](const QList<QByteArray>& row) {
        return row[kForceZ].toDouble() > 0.5;
    }));
    const QString message = QStringLiteral("flight.csv: %1 ticks of %2 s")
                                .arg(rows.size())
                                .arg(rows.back()[kTime].toDouble(), 0, 'f', 1);
    EXPECT_EQ(window_->statusBar()->currentMessage(), message);
    EXPECT_EQ(panelText(), message);
    EXPECT_TRUE(device().loop()->isRunning());
}

TEST_F(FlightRecordTest, IsAvailableAfterTheDeviceIsLost)
{
    ASSERT_TRUE(touch());
    ASSERT_TRUE(lose());
    EXPECT_TRUE(action().isEnabled());
    EXPECT_TRUE(button().isEnabled());
    // Offered next to the notice of the loss.
    const QList<QToolButton*> buttons =
        window_->findChild<NoticeBar*>()->findChildren<QToolButton*>();
    const QString text = action().text().remove(QLatin1Char('&'));
    const auto offered = std::find_if(buttons.begin(), buttons.end(), [&](const QToolButton* one) {
        return one->isVisible() && one->text() == text;
    });
    ASSERT_NE(offered, buttons.end());
    (*offered)->click();
    ASSERT_NE(dialog(), nullptr);
    const auto rows = saved(QStringLiteral("lost.csv"));
    ASSERT_GT(rows.size(), 200);
    EXPECT_EQ(rows.back()[kReason], lost());
    EXPECT_NE(rows.front()[kReason], rows.back()[kReason]);
    EXPECT_NE(device().notice(), QString()) << "the notice stays";
}

TEST_F(FlightRecordTest, ContainsTheLossAfterTheDeviceIsBack)
{
    ASSERT_TRUE(touch());
    ASSERT_TRUE(lose());
    hand_->is_lost = false;
    device().findDevices();
    ASSERT_TRUE(waitFor([&] { return !device().isFinding(); }));
    hand_->is_there = true;
    ASSERT_TRUE(
        waitFor([&] { return device().loop() != nullptr && device().loop()->state().tick > 300; }));
    button().click();
    ASSERT_NE(dialog(), nullptr);
    const auto rows = saved(QStringLiteral("back.csv"));
    int losses = 0;
    for (const auto& row : rows) {
        losses += row[kReason] == lost() ? 1 : 0;
    }
    EXPECT_GT(losses, 0);
    EXPECT_NE(rows.back()[kReason], lost());
    // The log of a device that was disconnected on purpose is cleared.
    device().disconnectDevice();
    ASSERT_TRUE(touch());
    for (const TickRecord& tick : device().lastTicks()) {
        ASSERT_NE(tick.reason, ForceOffReason::DeviceLost);
    }
}

TEST_F(FlightRecordTest, ContinuesWithAnotherMap)
{
    ASSERT_TRUE(touch());
    window_->controller().remove(window_->session().active);
    ASSERT_FALSE(device().loop()->isRunning());
    EXPECT_TRUE(action().isEnabled());
    ASSERT_TRUE(openAndWait(*window_, maps_.ring()));
    ASSERT_TRUE(waitFor([&] { return device().loop()->state().tick > 300; }));
    action().trigger();
    ASSERT_NE(dialog(), nullptr);
    const auto rows = saved(QStringLiteral("two.csv"));
    EXPECT_NE(rows.front()[kMap], rows.back()[kMap]);
    EXPECT_GT(rows.back()[kTick].toULongLong(), 200U);
}

TEST_F(FlightRecordTest, ReportsWhyItCannotBeWritten)
{
    ASSERT_TRUE(touch());
    action().trigger();
    ASSERT_NE(dialog(), nullptr);
    QSignalSpy failed(window_.get(), &MainWindow::openFailed);
    Q_EMIT dialog()->fileSelected(QStringLiteral("/no/such/folder/flight.csv"));
    ASSERT_TRUE(waitFor([&] { return failed.count() == 1; }));
    const QString problem = failed[0][0].toString();
    EXPECT_TRUE(problem.startsWith(
        QStringLiteral("/no/such/folder/flight.csv: the folder /no/such/folder does not exist")))
        << problem.toStdString();
    EXPECT_EQ(panelText(), problem);
}

} // namespace
} // namespace marsview
