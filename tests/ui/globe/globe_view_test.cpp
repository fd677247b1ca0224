// The globe in the window: View › Scene, navigation, readout, and what it disables.
#include "tests/core/measure/measured_map.h"
#include "tests/support/random.h"
#include "tests/ui/globe/globe_window.h"
#include "ui/commands/window_commands.h"
#include "ui/text/place_facts.h"
#include "ui/window/status_readout.h"

#include <QImage>
#include <QMenu>
#include <QMenuBar>
#include <QTest>

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace marsview {
namespace {

TEST_F(GlobeTest, ReplacesTheFlatMapAndHandsTheCameraOverBothWays)
{
    view().flyTo(GridPoint{400.0, 350.0}, 2e6);
    ASSERT_TRUE(waitFor([this] { return !view().isMoving(); }));
    const OrbitCamera before = view().camera();
    const auto place = view().map()->georeference().toGeographic(
        view().map()->georeference().sceneFrame().toGrid(before.target));
    ASSERT_TRUE(showGlobe());
    EXPECT_TRUE(view().isHidden());
    EXPECT_FALSE(globe().isHidden());
    EXPECT_NEAR(globe().camera().target.latitude.degrees(), place->latitude.degrees(), 1e-6);
    EXPECT_NEAR(globe().camera().distance_m, before.distance_m, 1e-6 * before.distance_m);
    ASSERT_TRUE(waitFor([this] { return globe().isPictureComplete(); }));
    scene(1)->trigger();
    EXPECT_FALSE(view().isHidden());
    EXPECT_TRUE(globe().isHidden());
    EXPECT_NEAR(view().camera().target.x, before.target.x, 1.0);
    EXPECT_NEAR(view().camera().target.y, before.target.y, 1.0);
    EXPECT_NEAR(view().camera().distance_m, before.distance_m, 1e-6 * before.distance_m);
}

// The view in which the bundled Mars opens: Tharsis, from so far that the body is seen as a ball.
TEST_F(GlobeTest, ShowsTheGroundOfAnObliqueFlatViewInsteadOfTheHorizonInItsMiddle)
{
    const OrbitCamera flat = view().camera();
    ASSERT_GT(flat.tilt.degrees(), 45.0);
    ASSERT_TRUE(showGlobe());
    for (const double height : {0.15, 0.5, 0.95}) {
        EXPECT_TRUE(globe().hitAt({globeMiddle().x(), height * globe().height()})) << height;
    }
    // Back without a motion: the oblique view.
    scene(1)->trigger();
    EXPECT_EQ(view().camera(), flat);
}

TEST_F(GlobeTest, ShowsABallBeforeTheSky)
{
    ASSERT_TRUE(showGlobe());
    globe().goHome();
    ASSERT_TRUE(rests());
    ASSERT_TRUE(waitFor([this] { return globe().isPictureComplete(); }));
    const QImage picture = globe().grabFramebuffer();
    const auto brightness = [&](double x, double y) {
        return qGray(picture.pixel(static_cast<int>(x * picture.width()),
                                   static_cast<int>(y * picture.height())));
    };
    EXPECT_GT(brightness(0.5, 0.5), 60);
    EXPECT_LT(brightness(0.01, 0.02), 60);
    EXPECT_LT(brightness(0.99, 0.98), 60);
    EXPECT_FALSE(globe().hitAt({1.0, 1.0}));
    EXPECT_TRUE(globe().hitAt(globeMiddle()));
}

TEST_F(GlobeTest, AnActionAndItsKeySwitchToItAndBack)
{
    QAction* action = window_->actionSet().globe;
    EXPECT_FALSE(action->icon().isNull());
    EXPECT_TRUE(action->isEnabled());
    EXPECT_FALSE(action->isChecked());
    action->trigger();
    ASSERT_TRUE(waitFor([this] { return globe().terrain() != nullptr; }));
    EXPECT_TRUE(view().isHidden());
    EXPECT_TRUE(action->isChecked());
    EXPECT_TRUE(scene(2)->isChecked());
    globe().setFocus();
    ASSERT_TRUE(waitFor([this] { return globe().hasFocus(); }));
    QTest::keyClick(&globe(), Qt::Key_G);
    EXPECT_TRUE(globe().isHidden());
    EXPECT_FALSE(action->isChecked());
    EXPECT_TRUE(scene(1)->isChecked());
    // Where the globe cannot be shown, the tip says why.
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    EXPECT_FALSE(action->isEnabled());
    EXPECT_TRUE(action->toolTip().contains(QStringLiteral("Set Body, CRS")));
}

TEST_F(GlobeTest, AWindowClosesWhileTheGlobeHasTheFocus)
{
    ASSERT_TRUE(showGlobe());
    globe().setFocus();
    ASSERT_TRUE(waitFor([this] { return globe().hasFocus(); }));
    window_.reset();
    SUCCEED() << "reports of the globe end before what shows them";
}

TEST_F(GlobeTest, TheFirstPictureHasItsColors)
{
    QImage first;
    QObject::connect(&globe(), &GlobeView::placed, &globe(), [&] {
        if (globe().terrain() != nullptr && first.isNull()) {
            first = globe().grabFramebuffer();
        }
    });
    ASSERT_TRUE(showGlobe());
    ASSERT_FALSE(first.isNull());
    EXPECT_GT(qGray(first.pixel(first.rect().center())), 30);
}

TEST_F(GlobeTest, ADragHoldsTheGroundUnderThePointer)
{
    ASSERT_TRUE(showGlobe());
    globe().setCamera({.target = {.longitude = Angle::degrees(179.5), .latitude = {}},
                       .distance_m = 3e6,
                       .tilt = Angle::degrees(30.0)});
    const QPoint from = globeMiddle().toPoint() + QPoint(40, 30);
    const QPoint to = from + QPoint(-130, 60);
    const ScenePoint held = pointAt(from);
    QTest::mousePress(&globe(), Qt::LeftButton, Qt::NoModifier, from);
    for (int i = 1; i <= 10; ++i) {
        move(from + (to - from) * i / 10, Qt::LeftButton);
    }
    QTest::mouseRelease(&globe(), Qt::LeftButton, Qt::NoModifier, to);
    const auto pixel = project(poseOf(globe().camera(), body()), globe().viewport(), held);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x, to.x(), 0.1);
    EXPECT_NEAR(pixel->y, to.y(), 0.1);
}

TEST_F(GlobeTest, TheWheelZoomsToThePointerAndTheKeysMove)
{
    ASSERT_TRUE(showGlobe());
    globe().goHome();
    ASSERT_TRUE(rests());
    const QPointF at = globeMiddle() + QPointF(60.0, -40.0);
    const ScenePoint held = pointAt(at);
    const double before_m = globe().camera().distance_m;
    for (int i = 0; i < 12; ++i) {
        wheel(at, 1);
    }
    ASSERT_TRUE(rests());
    EXPECT_LT(globe().camera().distance_m, 0.2 * before_m);
    const auto pixel = project(poseOf(globe().camera(), body()), globe().viewport(), held);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x, at.x(), 1.0);
    EXPECT_NEAR(pixel->y, at.y(), 1.0);

    const BodyCamera start = globe().camera();
    for (QAction* step : window_->actionSet().steps) {
        step->trigger();
        ASSERT_TRUE(rests());
    }
    EXPECT_NE(globe().camera(), start);
    window_->actionSet().north->trigger();
    ASSERT_TRUE(rests());
    EXPECT_NEAR(globe().camera().azimuth.degrees(), 0.0, 1e-9);
}

TEST_F(GlobeTest, ReadsTheFullResolutionElevationOfTheMapUnderThePointer)
{
    ASSERT_TRUE(showGlobe());
    globe().setCamera(
        {.target = {.longitude = Angle::degrees(-134.0), .latitude = Angle::degrees(18.6)},
         .distance_m = 1.2e6,
         .tilt = Angle::degrees(20.0)});
    const QPoint at = globeMiddle().toPoint() + QPoint(21, 13);
    move(at);
    const auto reading = globe().reading();
    ASSERT_TRUE(reading);
    const GeographicPoint place = placeAt(at);
    EXPECT_NEAR(reading->hit.height_m, globe().terrain()->map()->height(place), 0.5);
    ASSERT_TRUE(waitFor([this] { return !window_->readout()->heightLabel().isEmpty(); }));
    EXPECT_FALSE(window_->readout()->coordinateLabel().isEmpty());
}

// 2026-11: the latitude and the elevation of the outermost row of samples, 89.875°.
TEST_F(GlobeTest, ReadsThePlaceAtAPoleAndTheElevationOfProfiles)
{
    ASSERT_TRUE(showGlobe());
    const auto map = view().map();
    MeasuredTerrain measured = test::terrainOf(*map);
    for (const auto& [longitude_deg, latitude_deg] :
         {std::pair{30.0, 89.95}, {-160.0, 90.0}, {71.0, -89.93}, {200.0, -90.0}}) {
        const GeographicPoint place{.longitude = Angle::degrees(longitude_deg),
                                    .latitude = Angle::degrees(latitude_deg)};
        globe().setCamera({.target = place, .distance_m = 3e5});
        move(globeMiddle());
        ASSERT_TRUE(globe().reading());
        const BodyHit& hit = globe().reading()->hit;
        const auto read = map->georeference().toGeographic(hit.grid);
        ASSERT_TRUE(read);
        EXPECT_NEAR(read->latitude.degrees(), latitude_deg, 0.01);
        const double truth_m = measured.elevation(measured.ground().position(*read));
        EXPECT_NEAR(hit.height_m, truth_m, 0.5);
        EXPECT_FALSE(window_->readout()->heightLabel().isEmpty());
        const PlaceFacts facts = placeFacts(*map, {}, hit.grid, {});
        EXPECT_NEAR(facts.elevation.toDouble(), truth_m, 0.5);
    }
}

TEST_F(GlobeTest, ReadsWhereTheMapHasNoData)
{
    const TestMaps::Shape degrees{.x_lower_left = 0.0, .y_lower_left = 0.0, .cell = 0.5};
    const QString hollow =
        maps_.write(QStringLiteral("hollow.asc"), degrees, [](int column, int row) {
            return std::hypot(column - 29.5, row - 19.5) < 8.0 ? std::nan("") : 100.0;
        });
    writeMarsCrs(QStringLiteral("hollow.prj"));
    ASSERT_TRUE(openAndWait(*window_, hollow));
    window_->controller().setVisible(window_->session().layers.back().id, false);
    ASSERT_TRUE(showGlobe());
    const GridPoint middle{29.5, 19.5};
    const GeographicPoint target = *globe().terrain()->map()->georeference().toGeographic(middle);
    globe().setCamera({.target = target, .distance_m = 1e6});
    move(globeMiddle());
    EXPECT_FALSE(globe().groundAt(globeMiddle()));
    const auto reading = globe().reading();
    ASSERT_TRUE(reading);
    EXPECT_TRUE(std::isnan(reading->hit.height_m));
    EXPECT_NEAR(reading->hit.grid.column, middle.column, 1e-6); // straight down
    EXPECT_NEAR(reading->hit.grid.row, middle.row, 1e-6);
    EXPECT_EQ(window_->readout()->heightLabel(), QStringLiteral("no data"));
    globe().setCamera({.target = target, .distance_m = 2e7});
    move({1.0, 1.0}); // in the sky
    EXPECT_FALSE(globe().reading());
}

TEST_F(GlobeTest, HasTheActionsOfTheFlatMap)
{
    const auto enabled = [this] {
        QStringList texts;
        for (const QMenu* menu : window_->menuBar()->findChildren<QMenu*>()) {
            for (const QAction* action : menu->actions()) {
                if (action->isEnabled() && action->isVisible() && !action->isSeparator()) {
                    texts.append(menu->title() + QStringLiteral(" › ") + action->text());
                }
            }
        }
        return texts;
    };
    const QStringList flat = enabled();
    ASSERT_GT(flat.size(), 60);
    ASSERT_TRUE(showGlobe());
    EXPECT_EQ(enabled().join(QLatin1Char('\n')).toStdString(),
              flat.join(QLatin1Char('\n')).toStdString());
}

// Through the widget: the motions of core/globe have a hundred thousand inputs of their own.
TEST_F(GlobeTest, RandomInputNeverTakesTheCameraUnderTheGround)
{
    ASSERT_TRUE(showGlobe());
    test::Random random(81);
    const auto any = [&] {
        return QPoint(static_cast<int>(random.uniform(0.0, globe().width())),
                      static_cast<int>(random.uniform(0.0, globe().height())));
    };
    for (int i = 0; i < 400; ++i) {
        const QPoint from = any();
        if (i % 3 == 0) {
            const auto button = i % 2 == 0 ? Qt::LeftButton : Qt::RightButton;
            QTest::mousePress(&globe(), button, Qt::NoModifier, from);
            move(any(), button);
            QTest::mouseRelease(&globe(), button, Qt::NoModifier, any());
        } else if (i % 3 == 1) {
            wheel(from, random.uniform(0.0, 1.0) < 0.55 ? 2 : -2);
            QTest::qWait(20);
        } else {
            window_->actionSet().steps.at(static_cast<int>(random.uniform(0.0, 9.99)))->trigger();
        }
        const CameraPose pose = poseOf(globe().camera(), body());
        ASSERT_TRUE(isFinite(pose.eye)) << i;
        const BodyPlace eye = placeOf(pose.eye, body());
        ASSERT_GT(eye.height_m,
                  globe().terrain()->height(eye.foot) * window_->view()->exaggeration())
            << i;
    }
}

// 2026-11: "outside the map" until the next input.
TEST_F(GlobeTest, TheFlatMapIsReadAsSoonAsItReturns)
{
    ASSERT_TRUE(focusMap());
    view().step(NavigationStep::PanLeft); // by keys: the crosshair is read
    ASSERT_TRUE(showGlobe());
    scene(1)->trigger();
    EXPECT_TRUE(globe().isHidden());
    EXPECT_FALSE(window_->readout()->plainPosition().isEmpty());
}

} // namespace
} // namespace marsview
