// Recordings that start in the middle of a contact, and their traces by `marsview-cli trace`.
#include "core/contact/contact_model.h"
#include "haptics/trace/goal_file.h"
#include "tests/ui/hand_window.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"

#include <QFile>
#include <QProcess>
#include <QTest>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace marsview {
namespace {

// The cells of a table without its header.
using Rows = std::vector<QList<QByteArray>>;

Rows rowsIn(const QByteArray& text)
{
    Rows rows;
    const QList<QByteArray> lines = text.trimmed().split('\n');
    for (const QByteArray& line : lines.sliced(1)) {
        rows.push_back(line.trimmed().split(','));
    }
    return rows;
}

Rows rowsOf(const QString& file)
{
    QFile text(file);
    EXPECT_TRUE(text.open(QIODevice::ReadOnly));
    return rowsIn(text.readAll());
}

// The program's trace, with the options that a user would give.
Rows traced(const QString& map, const QString& goals)
{
    QProcess process;
    process.start(QStringLiteral(MARSVIEW_CLI),
                  {QStringLiteral("trace"), map, QStringLiteral("--goals"), goals});
    EXPECT_TRUE(process.waitForFinished(kTimeout));
    EXPECT_EQ(process.exitCode(), 0) << process.readAllStandardError().toStdString();
    return rowsIn(process.readAllStandardOutput());
}

class RecordingTest : public HandWindowTest {
protected:
    void SetUp() override { makeWindow(kSmall); }

    bool moveTo(const WorkspacePoint& at)
    {
        hand_->moveTo(at);
        return waitFor([&] { return length(state().hand - at) < 1e-9; });
    }
    // Connected, and deep below the surface after a stroke that is not in the file.
    bool beginTouching()
    {
        return connectTo(QStringLiteral("hand:")) && moveTo({-0.05, 0.03, -0.055}) &&
               moveTo({0.01, -0.02, -0.055}) &&
               waitFor([&] { return hand_->force_n > 0.5 && state().contact.is_in_contact; });
    }
    // A stroke that never leaves the surface.
    bool stroke()
    {
        return moveTo({0.04, 0.03, -0.05}) && moveTo({-0.03, 0.01, -0.055}) &&
               moveTo({0.02, -0.03, -0.045}) && moveTo({0.01, -0.02, -0.055});
    }
    void expectSameAgain(const QString& map, const QString& file)
    {
        const Rows recorded = rowsOf(file);
        const Rows again = traced(map, file);
        ASSERT_GT(recorded.size(), 50U);
        ASSERT_EQ(recorded.size(), again.size());
        for (std::size_t i = 0; i < recorded.size(); ++i) {
            ASSERT_EQ(recorded[i].sliced(6, 3), again[i].first(3)) << "update " << i;
            ASSERT_EQ(recorded[i][5], again[i][3]) << "update " << i;
        }
    }
};

TEST_F(RecordingTest, StartedWhileTouchingReplaysIdenticallyWithEveryModel)
{
    const QString map = maps_.hill();
    ASSERT_TRUE(openAndWait(*window_, map));
    ASSERT_TRUE(beginTouching());
    const QString file = maps_.path(QStringLiteral("touch.csv"));
    for (const ContactModelKind kind : kContactModelKinds) {
        SCOPED_TRACE(contactModelName(kind));
        haptics().setContactModel(kind);
        ASSERT_TRUE(stroke());
        ASSERT_TRUE(state().contact.is_in_contact);
        ASSERT_TRUE(haptics().recorder().start(file));
        ASSERT_TRUE(stroke());
        haptics().recorder().stop();
        const Rows recorded = rowsOf(file);
        EXPECT_TRUE(std::all_of(recorded.begin(), recorded.end(), [](const auto& row) {
            return row[5] == "1";
        })) << "it must stay in contact";
        EXPECT_EQ(recorded[0][16].toStdString(), contactModelName(kind));
        expectSameAgain(map, file);
    }
}

TEST_F(RecordingTest, OfACoveredMapReplaysIdentically)
{
    const QString lower = maps_.placed("lower", "IAU_2015:49900", {10, 0.25, 0, 40, 0, -0.25});
    ASSERT_TRUE(openAndWait(*window_, lower));
    ASSERT_TRUE(openAndWait(*window_,
                            maps_.placed("upper", "IAU_2015:49900", {16, 0.05, 0, 37, 0, -0.05})));
    ASSERT_EQ(view().ground().maps().size(), 2U);
    OrbitCamera camera = view().camera();
    camera.target = {-150'000.0, 0.0, 0.0}; // outside the upper map, whose middle is at 0
    camera.distance_m = 100'000.0;
    view().setCamera(camera);
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    ASSERT_TRUE(moveTo({0.01, -0.02, -0.055}));
    // Below the hand, and no more at the edge of the upper map.
    ASSERT_TRUE(waitFor([&] {
        const LoopState now = state();
        const double beside_m = now.contact.proxy.x - now.frame.toScene(now.hand).x;
        return now.contact.is_in_contact && std::abs(beside_m) < 20'000.0;
    }));
    ASSERT_NE(view().ground().maps()[1].frame,
              view().ground().maps()[1].map->georeference().sceneFrame());
    const QString file = maps_.path(QStringLiteral("touch.csv"));
    ASSERT_TRUE(haptics().recorder().start(file));
    ASSERT_TRUE(stroke());
    haptics().recorder().stop();
    expectSameAgain(lower, file);
}

TEST_F(RecordingTest, StartsWithoutAnEffectOnTheForce)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    ASSERT_TRUE(beginTouching());
    const QString file = maps_.path(QStringLiteral("touch.csv"));
    // On a busy machine the loop pauses now and then for long enough to switch the force off, with
    // or without a recording.
    bool is_disturbed = true;
    for (int i = 0; i < 50 && is_disturbed; ++i) {
        ASSERT_TRUE(waitFor([&] { return hand_->force_n > 0.5; }));
        const LoopState before = state();
        const double force_n = hand_->force_n;
        hand_->force_n_min = HUGE_VAL;
        ASSERT_TRUE(haptics().recorder().start(file));
        ASSERT_TRUE(waitFor([&] { return state().tick > before.tick + 200; }));
        haptics().recorder().stop();
        is_disturbed = state().counts.force_off != before.counts.force_off;
        if (!is_disturbed && before.reason == ForceOffReason::None) {
            EXPECT_NEAR(hand_->force_n_min, force_n, 0.05 * force_n);
        }
    }
    ASSERT_FALSE(is_disturbed);
    // Back to its old place: the first line puts the proxy of the new model there.
    const Rows recorded = rowsOf(file);
    ASSERT_GT(recorded.size(), 100U);
    for (qsizetype i = 6; i < 8; ++i) {
        EXPECT_NEAR(recorded.front()[i].toDouble(), recorded.back()[i].toDouble(), 0.5);
    }
}

} // namespace
} // namespace marsview
