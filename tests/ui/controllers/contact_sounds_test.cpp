// The sound of contact over a real view, played into memory.
#include "core/view/color_ramp.h"
#include "tests/support/map_maker.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"
#include "ui/controllers/contact_sounds.h"
#include "ui/controllers/haptics/flat_hand_scene.h"

#include <QApplication>
#include <QMouseEvent>
#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

namespace marsview {
namespace {

class ContactSoundsTest : public testing::Test {
protected:
    void SetUp() override
    {
        view_ = std::make_unique<TerrainView>();
        view_->setTool(Tool::Touch);
        view_->resize(800, 600);
        view_->show();
        ASSERT_TRUE(QTest::qWaitFor([this] { return view_->isReady(); }, kTimeout));
        const std::shared_ptr<const Map> map =
            maker_.make({.columns = 120, .rows = 90}, [](std::size_t c, std::size_t r) {
                return 100.0 * std::sin(static_cast<double>(c) / 11.0) +
                       20.0 * static_cast<double>(r % 3);
            });
        view_->setLayers({{.map = map, .ramp = colorRampNamed("grey")}});
        ASSERT_TRUE(QTest::qWaitFor([this] { return view_->isPictureComplete(); }, kTimeout));
    }
    void send(QEvent::Type type, QPointF at, Qt::MouseButton button, Qt::MouseButtons held)
    {
        QMouseEvent event(type, at, view_->mapToGlobal(at), button, held, Qt::NoModifier);
        QApplication::sendEvent(view_.get(), &event);
    }
    // Presses and slides across the middle of the view.
    void slide(const ContactSounds& sounds, double& loudest)
    {
        QPointF at(300, 300);
        send(QEvent::MouseMove, at, Qt::NoButton, Qt::NoButton);
        send(QEvent::MouseButtonPress, at, Qt::LeftButton, Qt::LeftButton);
        for (int i = 0; i < 30; ++i) {
            at += QPointF(6.0, 0.0);
            send(QEvent::MouseMove, at, Qt::NoButton, Qt::LeftButton);
            QTest::qWait(17); // one frame: sounds depend on how far the stylus moves per time
            loudest = std::max(loudest, sounds.sound().noise_gain + sounds.sound().tone_gain);
        }
    }

    test::MapMaker maker_;
    std::unique_ptr<TerrainView> view_;
};

TEST_F(ContactSoundsTest, AreSilentUntilSwitchedOnAndHeardWhileTheMouseTouches)
{
    FlatHandScene scene(*view_);
    ContactSounds sounds(scene, [] { return SoundPlayer::openLoopback(); });
    double loudest = 0.0;
    slide(sounds, loudest);
    EXPECT_EQ(loudest, 0.0);
    EXPECT_FALSE(sounds.isReady());
    send(QEvent::MouseButtonRelease, {480, 300}, Qt::LeftButton, Qt::NoButton);

    sounds.setOn(true);
    ASSERT_TRUE(QTest::qWaitFor([&] { return sounds.isReady(); }, kTimeout));
    slide(sounds, loudest);
    EXPECT_GT(loudest, 0.05);
    std::vector<float> heard(2 * 4800);
    sounds.player()->render(heard);
    double energy = 0.0;
    for (const float sample : heard) {
        energy += static_cast<double>(sample) * static_cast<double>(sample);
    }
    EXPECT_GT(energy, 1e-3);

    send(QEvent::MouseButtonRelease, {480, 300}, Qt::LeftButton, Qt::NoButton);
    EXPECT_TRUE(QTest::qWaitFor(
        [&] { return sounds.sound().noise_gain == 0.0 && sounds.sound().tone_gain == 0.0; },
        kTimeout));
}

TEST_F(ContactSoundsTest, ReportAMissingOutputAndSwitchOff)
{
    FlatHandScene scene(*view_);
    ContactSounds sounds(scene, []() -> Result<SoundPlayer> {
        return Error{ErrorCode::NotFound, "sound: no output device"};
    });
    QSignalSpy failed(&sounds, &ContactSounds::failed);
    sounds.setOn(true);
    ASSERT_TRUE(QTest::qWaitFor([&] { return failed.count() == 1; }, kTimeout));
    EXPECT_EQ(failed.at(0).at(0).toString(), QStringLiteral("sound: no output device"));
    EXPECT_FALSE(sounds.isOn());
    EXPECT_FALSE(sounds.isReady());
}

} // namespace
} // namespace marsview
