#include "tests/ui/test_map.h"
#include "ui/canvas/terrain_view.h"
#include "ui/widgets/exaggeration_control.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QApplication>
#include <QLineEdit>
#include <QMouseEvent>
#include <QSignalSpy>
#include <QStyle>
#include <QStyleOptionSlider>
#include <QTest>
#include <QToolButton>
#include <QToolTip>
#include <QWheelEvent>

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

namespace marsview {
namespace {

class ExaggerationTest : public testing::Test {
protected:
    void SetUp() override
    {
        window_ = std::make_unique<MainWindow>(testWindowOptions());
        window_->resize(1500, 800);
        window_->show();
        QApplication::setActiveWindow(window_.get()); // without a window manager
        ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    }

    TerrainView& view() { return *window_->view(); }
    QUndoStack& steps() { return window_->undoStack(); }
    ExaggerationBox& box() { return *window_->findChild<ExaggerationBox*>(); }
    ExaggerationSlider& slider() { return *window_->findChild<ExaggerationSlider*>(); }
    void type(const QString& text)
    {
        box().selectAll();
        QTest::keyClicks(&box(), text);
        QTest::keyClick(&box(), Qt::Key_Return);
    }
    QPoint handle()
    {
        QStyleOptionSlider option;
        option.initFrom(&slider());
        option.orientation = Qt::Horizontal;
        option.minimum = slider().minimum();
        option.maximum = slider().maximum();
        option.sliderPosition = slider().sliderPosition();
        option.sliderValue = slider().value();
        option.subControls = QStyle::SC_All;
        return slider()
            .style()
            ->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderHandle, &slider())
            .center();
    }

    TestMaps maps_;
    std::unique_ptr<MainWindow> window_;
};

TEST_F(ExaggerationTest, CanBeTyped)
{
    type(QStringLiteral("2.7"));
    EXPECT_DOUBLE_EQ(view().exaggeration(), 2.7);
    EXPECT_EQ(box().text(), QStringLiteral("×2.7"));
    EXPECT_EQ(steps().undoText(), QStringLiteral("Exaggeration ×2.7"));
    type(QStringLiteral("×0.25"));
    EXPECT_DOUBLE_EQ(view().exaggeration(), 0.25);
    type(QStringLiteral("5000"));
    EXPECT_DOUBLE_EQ(view().exaggeration(), 100.0) << "the largest factor";
    EXPECT_EQ(QToolTip::text(), QStringLiteral("Vertical exaggeration goes from ×0.1 to ×100."));
    type(QStringLiteral("0.001"));
    EXPECT_DOUBLE_EQ(view().exaggeration(), 0.1) << "the smallest factor";
}

TEST_F(ExaggerationTest, HasAButtonForTrueScale)
{
    window_->controller().setExaggeration(12.0);
    auto* button = window_->findChild<QToolButton*>(QStringLiteral("trueScale"));
    EXPECT_FALSE(button->isChecked());
    for (int i = 0; i < 2; ++i) {
        button->click();
        EXPECT_DOUBLE_EQ(view().exaggeration(), 1.0);
        EXPECT_TRUE(button->isChecked());
    }
    EXPECT_EQ(slider().value(), 0) << "the marked position";
    EXPECT_EQ(steps().undoText(), QStringLiteral("Exaggeration ×1"));
}

TEST_F(ExaggerationTest, IsUndoneWithoutMovingTheCameraOffThePlace)
{
    const double first = view().exaggeration();
    view().flyTo({.column = 12.0, .row = 9.0}, 4e5);
    ASSERT_TRUE(waitUntilSettled(*window_));
    const OrbitCamera camera = view().camera();
    window_->controller().setExaggeration(3.0 * first);
    EXPECT_NEAR(view().camera().target.z, 3.0 * camera.target.z, 5.0);
    steps().undo();
    EXPECT_DOUBLE_EQ(view().exaggeration(), first);
    EXPECT_NEAR(length(view().camera().target - camera.target), 0.0, 1.0);
    EXPECT_NEAR(view().camera().distance_m, camera.distance_m, 1.0);
    steps().redo();
    EXPECT_DOUBLE_EQ(view().exaggeration(), 3.0 * first);
    EXPECT_DOUBLE_EQ(box().value(), 3.0 * first);
}

TEST_F(ExaggerationTest, KeysAndMenuMakeOneStepEach)
{
    window_->controller().setExaggeration(1.0);
    const int count = steps().count();
    view().setFocus();
    QTest::keyClick(&view(), Qt::Key_Plus);
    QTest::keyClick(&view(), Qt::Key_Plus);
    EXPECT_DOUBLE_EQ(view().exaggeration(), 2.0);
    window_->actionSet().exaggerate_less->trigger();
    EXPECT_DOUBLE_EQ(view().exaggeration(), 1.5);
    EXPECT_EQ(steps().count(), count + 3);
    steps().undo();
    EXPECT_DOUBLE_EQ(view().exaggeration(), 2.0);
}

TEST_F(ExaggerationTest, ADragOfTheSliderIsOneStep)
{
    window_->controller().setExaggeration(1.0);
    const int count = steps().count();
    const QPoint from = handle();
    const auto drag = [this](QPoint begin, int by) {
        QTest::mousePress(&slider(), Qt::LeftButton, {}, begin);
        for (int i = 1; i <= 4; ++i) {
            const QPointF at = QPointF(begin) + QPointF(by * i / 4.0, 0.0);
            QMouseEvent move(QEvent::MouseMove, at, slider().mapToGlobal(at), Qt::NoButton,
                             Qt::LeftButton, Qt::NoModifier);
            QCoreApplication::sendEvent(&slider(), &move);
        }
        QTest::mouseRelease(&slider(), Qt::LeftButton, {}, begin + QPoint(by, 0));
    };
    drag(from, 20);
    const double once = view().exaggeration();
    EXPECT_GT(once, 1.5);
    EXPECT_EQ(steps().count(), count + 1);
    EXPECT_EQ(steps().undoText(), QStringLiteral("Exaggeration ×%1").arg(once));
    drag(handle(), 15);
    EXPECT_GT(view().exaggeration(), once);
    EXPECT_EQ(steps().count(), count + 2) << "another drag is another step";
    steps().undo();
    EXPECT_DOUBLE_EQ(view().exaggeration(), once);
    steps().undo();
    EXPECT_DOUBLE_EQ(view().exaggeration(), 1.0);
    // A drag back to its start is not an undo step.
    const QPoint begin = handle();
    QTest::mousePress(&slider(), Qt::LeftButton, {}, begin);
    for (const int by : {15, 0}) {
        const QPointF at = QPointF(begin) + QPointF(by, 0.0);
        QMouseEvent move(QEvent::MouseMove, at, slider().mapToGlobal(at), Qt::NoButton,
                         Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(&slider(), &move);
    }
    QTest::mouseRelease(&slider(), Qt::LeftButton, {}, begin);
    EXPECT_DOUBLE_EQ(view().exaggeration(), 1.0);
    EXPECT_EQ(steps().index(), count);
}

TEST_F(ExaggerationTest, ReturnGivesTheKeysBackToTheMap)
{
    window_->controller().setExaggeration(2.0);
    box().setFocus();
    ASSERT_TRUE(QTest::qWaitFor([this] { return box().hasFocus(); }, kTimeout));
    type(QStringLiteral("50"));
    EXPECT_DOUBLE_EQ(view().exaggeration(), 50.0);
    ASSERT_TRUE(QTest::qWaitFor([this] { return view().hasFocus(); }, kTimeout));
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Z, Qt::ControlModifier);
    EXPECT_DOUBLE_EQ(view().exaggeration(), 2.0);
    // A factor beyond the range stays to be corrected, with the tooltip that names the range.
    box().setFocus();
    ASSERT_TRUE(QTest::qWaitFor([this] { return box().hasFocus(); }, kTimeout));
    type(QStringLiteral("5000"));
    QCoreApplication::processEvents();
    EXPECT_TRUE(box().hasFocus());
}

TEST_F(ExaggerationTest, TheBoxUndoesWhatIsTypedAndOtherwiseTheWindowDoes)
{
    window_->controller().setExaggeration(2.0);
    window_->controller().setExaggeration(3.0);
    box().setFocus();
    ASSERT_TRUE(QTest::qWaitFor([this] { return box().hasFocus(); }, kTimeout));
    QTest::keyClick(&box(), Qt::Key_Z, Qt::ControlModifier);
    EXPECT_DOUBLE_EQ(view().exaggeration(), 2.0);
    QTest::keyClick(&box(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_DOUBLE_EQ(view().exaggeration(), 3.0);
    box().selectAll();
    QTest::keyClicks(&box(), QStringLiteral("7"));
    ASSERT_NE(box().text(), QStringLiteral("×3"));
    QTest::keyClick(&box(), Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(box().text(), QStringLiteral("×3"));
    EXPECT_DOUBLE_EQ(view().exaggeration(), 3.0);
}

TEST_F(ExaggerationTest, AClickOnTheSliderKeepsTheKeysOfTheMap)
{
    window_->controller().setExaggeration(1.0);
    view().setFocus();
    ASSERT_TRUE(QTest::qWaitFor([this] { return view().hasFocus(); }, kTimeout));
    QTest::mouseClick(&slider(), Qt::LeftButton, {}, handle());
    EXPECT_TRUE(view().hasFocus());
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Plus);
    EXPECT_DOUBLE_EQ(view().exaggeration(), 1.5);
}

TEST_F(ExaggerationTest, NotchesOfTheWheelAreOneStepUntilItPauses)
{
    window_->controller().setExaggeration(1.0);
    const int count = steps().count();
    QSignalSpy pauses(window_->findChild<ExaggerationControl*>(), &ExaggerationControl::dragEnded);
    const auto roll = [](QWidget& over) {
        for (int i = 0; i < 3; ++i) {
            const QPointF at = QRectF(over.rect()).center();
            QWheelEvent event(at, over.mapToGlobal(at), {}, {0, 120}, Qt::NoButton, Qt::NoModifier,
                              Qt::NoScrollPhase, false);
            QApplication::sendEvent(&over, &event);
        }
    };
    for (QWidget* over : std::initializer_list<QWidget*>{&slider(), &box()}) {
        const double before = view().exaggeration();
        const int index = steps().index();
        pauses.clear();
        roll(*over);
        EXPECT_GT(view().exaggeration(), before * 2.0);
        EXPECT_EQ(steps().index(), index + 1);
        ASSERT_EQ(pauses.count(), 1) << "at the beginning";
        ASSERT_TRUE(pauses.wait(kTimeout));
        roll(*over);
        EXPECT_EQ(steps().index(), index + 2) << "after a pause";
        ASSERT_TRUE(pauses.wait(kTimeout));
        steps().undo();
        steps().undo();
        EXPECT_DOUBLE_EQ(view().exaggeration(), before);
    }
    EXPECT_EQ(steps().index(), count);
}

TEST_F(ExaggerationTest, IsThatOfEachMapWhenTheyAlternate)
{
    window_->controller().setExaggeration(3.0);
    ASSERT_TRUE(openAndWait(*window_, maps_.moon()));
    const double suitable = suitableExaggeration(*view().map());
    EXPECT_DOUBLE_EQ(view().exaggeration(), suitable);
    EXPECT_NEAR(box().value(), suitable, 1e-6);
    window_->controller().setVisible(window_->session().layers.front().id, false);
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_DOUBLE_EQ(view().exaggeration(), 3.0);
    EXPECT_DOUBLE_EQ(box().value(), 3.0);
}

} // namespace
} // namespace marsview
