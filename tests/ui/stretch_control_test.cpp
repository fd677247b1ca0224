// The color stretch as the user sees it: menu, dialog, picture, undo.
#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"
#include "ui/commands/stretch_control.h"
#include "ui/dialogs/stretch_dialog.h"
#include "ui/dialogs/stretch_plot.h"
#include "ui/overlay/legend.h"
#include "ui/overlay/map_overlays.h"
#include "ui/widgets/elevation_box.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QComboBox>
#include <QHelpEvent>
#include <QImage>
#include <QLabel>
#include <QMouseEvent>
#include <QPushButton>
#include <QTest>
#include <QToolTip>

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

class StretchTest : public testing::Test {
protected:
    void SetUp() override
    {
        window_ = std::make_unique<MainWindow>(testWindowOptions());
        window_->resize(1280, 800);
        window_->show();
        // Elevations 0 … 990 from west to east.
        ASSERT_TRUE(openAndWait(
            *window_, maps_.write(QStringLiteral("slope.asc"), {.columns = 100, .rows = 60},
                                  [](int column, int) { return 10.0 * column; })));
    }

    SessionController& controller() { return window_->controller(); }
    const Layer& layer(std::size_t index = 0) { return window_->session().layers.at(index); }
    HeightRange shown() { return colorRangeOf(window_->view()->shownLayers().front()); }
    HeightRange explained() { return window_->overlays()->legend()->content().range; }
    void choose(StretchKind kind)
    {
        for (QAction* action : window_->actionSet().stretch_group->actions()) {
            if (action->data().toInt() == static_cast<int>(kind)) {
                action->trigger();
            }
        }
    }
    StretchKind checked()
    {
        return static_cast<StretchKind>(
            window_->actionSet().stretch_group->checkedAction()->data().toInt());
    }
    StretchDialog& dialog() { return *window_->stretch().dialog(); }
    template <typename Part>
    Part& part(const char* name)
    {
        return *dialog().findChild<Part*>(QLatin1String(name));
    }
    void type(ElevationBox& box, const QString& text)
    {
        box.selectAll();
        QTest::keyClicks(&box, text);
        QTest::keyClick(&box, Qt::Key_Return);
    }

    TestMaps maps_;
    std::unique_ptr<MainWindow> window_;
};

TEST_F(StretchTest, CutsAPercentageInPictureAndLegend)
{
    choose(StretchKind::Full);
    EXPECT_EQ(shown().minimum_m, 0.0);
    EXPECT_EQ(shown().maximum_m, 990.0);
    choose(StretchKind::Percentile);
    EXPECT_EQ(checked(), StretchKind::Percentile);
    // 2 % of 6000 samples are 120: two columns at either end.
    EXPECT_EQ(shown().minimum_m, 20.0);
    EXPECT_EQ(shown().maximum_m, 970.0);
    EXPECT_EQ(explained().minimum_m, 20.0);
    EXPECT_EQ(explained().maximum_m, 970.0);
    EXPECT_TRUE(window_->overlays()->legend()->hasLower());
    EXPECT_TRUE(window_->overlays()->legend()->hasHigher());
    part<QDoubleSpinBox>("cut").setValue(10.0);
    EXPECT_EQ(shown().minimum_m, 100.0);
    EXPECT_EQ(shown().maximum_m, 890.0);
    EXPECT_EQ(window_->undoStack().undoText(), QStringLiteral("Color Stretch of slope.asc"));
    window_->undoStack().undo();
    EXPECT_EQ(shown().minimum_m, 20.0);
    choose(StretchKind::Full);
    EXPECT_FALSE(window_->overlays()->legend()->hasHigher());
}

TEST_F(StretchTest, LegendShowsTheExtremesInATooltip)
{
    choose(StretchKind::Percentile);
    TerrainView& view = *window_->view();
    const Legend& legend = *window_->overlays()->legend();
    const QPoint at = legend.geometry().center();
    QHelpEvent help(QEvent::ToolTip, at, view.mapToGlobal(at));
    QCoreApplication::sendEvent(&view, &help);
    EXPECT_EQ(QToolTip::text(), legend.summary());
    EXPECT_TRUE(QToolTip::text().contains(QStringLiteral("lowest 0 m")))
        << QToolTip::text().toStdString();
    EXPECT_TRUE(QToolTip::text().contains(QStringLiteral("highest 990 m")));
    QToolTip::hideText();
}

TEST_F(StretchTest, ChangesTheColorsOfThePicture)
{
    choose(StretchKind::Full); // unchanged: the map is too small to cut anything
    const QImage before = window_->view()->terrainPicture();
    controller().setStretch(layer().id, fixedStretch(2000.0, 3000.0));
    ASSERT_TRUE(waitUntilSettled(*window_));
    const QImage below = window_->view()->terrainPicture();
    const QPoint middle = before.rect().center();
    EXPECT_NE(before.pixelColor(middle), below.pixelColor(middle));
    // Below its lower end the ramp has one color: east and west differ only by their light.
    const QPoint west(before.width() / 3, middle.y());
    const QPoint east(before.width() * 2 / 3, middle.y());
    const auto difference = [](const QColor& a, const QColor& b) {
        return std::abs(a.red() - b.red()) + std::abs(a.green() - b.green()) +
               std::abs(a.blue() - b.blue());
    };
    EXPECT_GT(difference(before.pixelColor(west), before.pixelColor(east)), 40);
    EXPECT_LE(difference(below.pixelColor(west), below.pixelColor(east)), 6);
}

TEST_F(StretchTest, TakesWhatThePictureShowsNow)
{
    TerrainView& view = *window_->view();
    // From straight above, the middle of the map in the middle.
    OrbitCamera camera = view.camera();
    camera.tilt = {};
    camera.azimuth = {};
    camera.target = {0.0, 0.0, 495.0 * view.exaggeration()};
    camera.distance_m = 900.0;
    view.setCamera(camera);
    window_->actionSet().stretch_to_view->trigger();
    EXPECT_EQ(checked(), StretchKind::Fixed);
    const auto height_at = [&](double x) {
        return view.surfaceAt(QPointF(x, view.height() / 2.0))->height_m;
    };
    EXPECT_NEAR(layer().stretch.low, height_at(0.0), 3.0);
    EXPECT_NEAR(layer().stretch.high, height_at(view.width() - 0.01), 3.0);
    EXPECT_GT(layer().stretch.low, 100.0) << "less than the whole map";
    EXPECT_EQ(shown().minimum_m, layer().stretch.low);
    const ColorStretch fixed = layer().stretch;
    camera.distance_m = 400.0;
    view.setCamera(camera);
    EXPECT_EQ(layer().stretch, fixed) << "further camera moves do not change it";
    window_->undoStack().undo();
    EXPECT_EQ(layer().stretch.kind, StretchKind::Automatic);
}

TEST_F(StretchTest, TakesTypedEndsInTheUnitOfThePreferences)
{
    window_->actionSet().edit_stretch->trigger();
    ASSERT_TRUE(dialog().isVisible());
    EXPECT_FALSE(dialog().isModal());
    type(part<ElevationBox>("low"), QStringLiteral("-250"));
    type(part<ElevationBox>("high"), QStringLiteral("1500"));
    EXPECT_EQ(layer().stretch, fixedStretch(-250.0, 1500.0));
    EXPECT_EQ(part<ElevationBox>("low").text(), QStringLiteral("−250 m"));
    window_->setPreferences({.height_unit = HeightUnit::Feet});
    EXPECT_TRUE(part<ElevationBox>("high").text().endsWith(QStringLiteral(" ft")));
    EXPECT_NEAR(part<ElevationBox>("high").value(), 1500.0 / 0.3048, 0.6);
    type(part<ElevationBox>("high"), QStringLiteral("3000"));
    EXPECT_NEAR(layer().stretch.high, 3000.0 * 0.3048, 1e-9);
    EXPECT_EQ(layer().stretch.low, -250.0) << "a limit that was not edited stays exact";
    window_->setPreferences({});
}

TEST_F(StretchTest, RefusesAMinimumAboveTheMaximumNextToTheFields)
{
    window_->actionSet().edit_stretch->trigger();
    const ColorStretch before = layer().stretch;
    type(part<ElevationBox>("low"), QStringLiteral("5000"));
    EXPECT_EQ(layer().stretch, before);
    EXPECT_EQ(part<QLabel>("note").text(),
              QStringLiteral("The minimum must be below the maximum."));
    type(part<ElevationBox>("high"), QStringLiteral("6000"));
    EXPECT_EQ(layer().stretch, fixedStretch(5000.0, 6000.0));
    EXPECT_TRUE(part<QLabel>("note").text().isEmpty());
}

TEST_F(StretchTest, ADraggedEndIsOneStepBack)
{
    window_->actionSet().edit_stretch->trigger();
    choose(StretchKind::Full);
    auto& plot = *dialog().findChild<StretchPlot*>();
    const int count = window_->undoStack().count();
    const int y = plot.height() / 2;
    const int from = plot.positionOf(990.0);
    QTest::mousePress(&plot, Qt::LeftButton, {}, {from, y});
    for (const double height : {900.0, 700.0, 495.0}) {
        const QPointF at(plot.positionOf(height), y);
        QMouseEvent move(QEvent::MouseMove, at, plot.mapToGlobal(at), Qt::NoButton, Qt::LeftButton,
                         Qt::NoModifier);
        QCoreApplication::sendEvent(&plot, &move);
    }
    QTest::mouseRelease(&plot, Qt::LeftButton, {}, {plot.positionOf(495.0), y});
    EXPECT_EQ(window_->undoStack().count(), count + 1);
    EXPECT_EQ(layer().stretch.kind, StretchKind::Fixed);
    EXPECT_EQ(layer().stretch.low, 0.0);
    EXPECT_NEAR(layer().stretch.high, 495.0, 5.0); // a pixel is 3 m
    window_->undoStack().undo();
    EXPECT_EQ(layer().stretch.kind, StretchKind::Full);
}

TEST_F(StretchTest, IsOfEachLayer)
{
    controller().setStretch(layer().id, fixedStretch(5.0, 6.0));
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    EXPECT_EQ(layer(0).stretch, ColorStretch{});
    EXPECT_EQ(layer(1).stretch, fixedStretch(5.0, 6.0));
    EXPECT_EQ(checked(), StretchKind::Automatic);
    controller().activate(layer(1).id);
    EXPECT_EQ(checked(), StretchKind::Fixed);
}

TEST_F(StretchTest, IsSymmetricWhereTheRampDiverges)
{
    controller().setRamp(layer().id, QStringLiteral("datum"));
    controller().setStretch(layer().id, fixedStretch(-100.0, 400.0));
    EXPECT_EQ(shown().minimum_m, -400.0);
    EXPECT_EQ(shown().maximum_m, 400.0);
    EXPECT_EQ(explained().minimum_m, -400.0);
    window_->actionSet().edit_stretch->trigger();
    EXPECT_TRUE(part<QLabel>("note").text().contains(QStringLiteral("−400")))
        << part<QLabel>("note").text().toStdString();
}

TEST_F(StretchTest, OfSlopesIsInDegrees)
{
    controller().setShading(ShadingMode::Slope);
    Legend& legend = *window_->overlays()->legend();
    EXPECT_EQ(legend.content().slopes, window_->view()->map()->slopeRange());
    EXPECT_FALSE(window_->actionSet().stretch_to_view->isVisible());
    for (const QAction* action : window_->actionSet().stretch_group->actions()) {
        const auto kind = static_cast<StretchKind>(action->data().toInt());
        EXPECT_EQ(action->isVisible(),
                  kind == StretchKind::Automatic || kind == StretchKind::Fixed);
        EXPECT_EQ(action->isVisible(), action->statusTip().contains(QStringLiteral("slope")));
    }
    choose(StretchKind::Fixed);
    ASSERT_TRUE(dialog().isVisible());
    type(part<ElevationBox>("high"), QStringLiteral("12.5"));
    ASSERT_TRUE(layer().slope_range);
    EXPECT_NEAR(layer().slope_range->maximum.degrees(), 12.5, 1e-9);
    EXPECT_NEAR(legend.content().slopes.maximum.degrees(), 12.5, 1e-9);
    EXPECT_EQ(layer().stretch, ColorStretch{}) << "elevations keep their stretch";
    EXPECT_EQ(window_->undoStack().undoText(), QStringLiteral("Slope Colors of slope.asc"));
    choose(StretchKind::Automatic);
    EXPECT_FALSE(layer().slope_range);
}

TEST_F(StretchTest, OfSlopesHasAHistogramAndNothingThatIsEmpty)
{
    window_->actionSet().edit_stretch->trigger();
    controller().setShading(ShadingMode::Slope);
    ASSERT_TRUE(QTest::qWaitFor([this] { return dialog().isVisible(); }, kTimeout));
    auto& plot = *dialog().findChild<StretchPlot*>();
    EXPECT_TRUE(plot.isVisible());
    EXPECT_EQ(plot.accessibleName(), QStringLiteral("Histogram of slopes"));
    // Bars, in colors of the ramp.
    const QImage bars = plot.grab().toImage();
    const QRgb background = plot.palette().color(QPalette::Base).rgb();
    int colored = 0;
    for (int x = 10; x < bars.width() - 10; ++x) {
        for (int y = 4; y < bars.height() - 12; ++y) {
            colored += bars.pixel(x, y) != background ? 1 : 0;
        }
    }
    EXPECT_GT(colored, bars.width());
    EXPECT_LE(dialog().height(), dialog().sizeHint().height() + 4);
    // Its ends can be dragged, as one step of undo.
    const int steps = window_->undoStack().index();
    const double before = controller().slopeRangeOf(layer()).maximum.degrees();
    const QPoint end(plot.positionOf(before), plot.height() / 2);
    QTest::mousePress(&plot, Qt::LeftButton, {}, end);
    for (const int moved : {10, 30, 60}) {
        QMouseEvent move(QEvent::MouseMove, end - QPoint(moved, 0),
                         plot.mapToGlobal(end - QPoint(moved, 0)), Qt::NoButton, Qt::LeftButton,
                         Qt::NoModifier);
        QApplication::sendEvent(&plot, &move);
    }
    QTest::mouseRelease(&plot, Qt::LeftButton, {}, end - QPoint(60, 0));
    EXPECT_LT(controller().slopeRangeOf(layer()).maximum.degrees(), before);
    EXPECT_EQ(window_->undoStack().index(), steps + 1);
}

TEST_F(StretchTest, OfAConstantMapDoesNoHarm)
{
    ASSERT_TRUE(openAndWait(
        *window_, maps_.write(QStringLiteral("flat.asc"), {}, [](int, int) { return 12.0; })));
    window_->actionSet().edit_stretch->trigger();
    for (const StretchKind kind :
         {StretchKind::Full, StretchKind::Percentile, StretchKind::Fixed, StretchKind::Automatic}) {
        choose(kind);
        ASSERT_TRUE(
            QTest::qWaitFor([this] { return window_->view()->isPictureComplete(); }, kTimeout));
    }
    EXPECT_EQ(part<QLabel>("note").text(), QStringLiteral("All samples have the same elevation."));
}

TEST_F(StretchTest, LegendIsOfTheActiveLayerInThePicture)
{
    const QString lower = maps_.placed("lower", "EPSG:32611", {5e5, 30, 0, 4e6, 0, -30});
    const QString upper = maps_.placed("upper", "EPSG:32611", {5e5 + 300, 30, 0, 4e6, 0, -30});
    controller().open({lower, upper});
    ASSERT_TRUE(waitUntilSettled(*window_));
    Legend& legend = *window_->overlays()->legend();
    const LegendContent& content = legend.content();
    EXPECT_EQ(content.layer, QStringLiteral("upper.vrt"));
    controller().activate(layer(1).id);
    EXPECT_EQ(content.layer, QStringLiteral("lower.vrt"));
    controller().setStretch(layer(1).id, fixedStretch(-7.0, 9.0));
    EXPECT_EQ(content.range.minimum_m, -7.0);
    // If the active layer is not in the picture, the legend shows the topmost one that is.
    controller().activate(layer(2).id);
    EXPECT_EQ(content.layer, QStringLiteral("upper.vrt"));
    // Only the lower one is in the view now.
    TerrainView& view = *window_->view();
    OrbitCamera camera = view.camera();
    camera.tilt = {};
    camera.target =
        view.ground().maps()[1].frame.toScene({3.0, 15.0}, -240.0 * view.exaggeration());
    camera.distance_m = 200.0;
    view.setCamera(camera);
    EXPECT_TRUE(QTest::qWaitFor(
        [&] { return legend.content().layer == QStringLiteral("lower.vrt"); }, kTimeout))
        << legend.content().layer.toStdString();
}

} // namespace
} // namespace marsview
