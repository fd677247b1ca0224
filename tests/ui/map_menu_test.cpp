// The context menu of a point on the map, by mouse and by keyboard.

#include "core/terrain/surface_slope.h"
#include "tests/ui/map_window.h"
#include "ui/commands/map_menu.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/dialogs/place_dialog.h"
#include "ui/overlay/map_overlays.h"
#include "ui/panels/measure_panel.h"

#include <QApplication>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QScreen>
#include <QTest>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace marsview {
namespace {

class MapMenuTest : public MapWindowTest {
protected:
    void SetUp() override
    {
        makeWindow(kSmall);
        // Rises by 6 m to the east and 3 m to the north per cell of 30 m.
        ASSERT_TRUE(openAndWait(
            *window_, maps_.write(QStringLiteral("plane.asc"), {}, [](int column, int row) {
                return 6.0 * column - 3.0 * row + 1000.0;
            })));
        ASSERT_TRUE(focusMap());
    }
    void TearDown() override
    {
        delete menu();
        window_.reset();
    }

    QMenu* menu() { return window_->commands().places.mapMenu()->menu(); }
    PlaceDialog* card() { return window_->commands().places.mapMenu()->card(); }
    QPointF placeOf(GridPoint grid) { return view().positionOf(grid).value(); }
    void rightClick(QPointF at)
    {
        const auto send = [&](QEvent::Type type, Qt::MouseButtons held) {
            QMouseEvent event(type, at, view().mapToGlobal(at), Qt::RightButton, held,
                              Qt::NoModifier);
            QApplication::sendEvent(&view(), &event);
        };
        send(QEvent::MouseButtonPress, Qt::RightButton);
        send(QEvent::MouseButtonRelease, Qt::NoButton);
    }
    QAction* entry(const char* text)
    {
        for (QAction* action : menu()->actions()) {
            if (action->text().remove(QLatin1Char('&')) == QString::fromUtf8(text)) {
                return action;
            }
        }
        return nullptr;
    }
    QString fact(const QString& name)
    {
        for (const QLabel* label : card()->findChildren<QLabel*>()) {
            if (label->accessibleName() == name) {
                return label->text();
            }
        }
        return {};
    }
};

TEST_F(MapMenuTest, CopiesTheElevationOfTheClickedPlace)
{
    rightClick(placeOf({20.0, 12.0}));
    ASSERT_NE(menu(), nullptr);
    EXPECT_TRUE(menu()->isVisible());
    entry("Copy Elevation")->trigger();
    EXPECT_NEAR(QGuiApplication::clipboard()->text().toDouble(), 6.0 * 20 - 3.0 * 12 + 1000.0, 0.2);
    entry("Copy Coordinates")->trigger();
    // Samples are 30 m apart; the lower left corner of the grid is at (500000, 4000000).
    const QString text = QGuiApplication::clipboard()->text();
    EXPECT_FALSE(text.isEmpty());
}

TEST_F(MapMenuTest, FliesAndCenters)
{
    const double before = view().camera().distance_m;
    rightClick(placeOf({25.0, 15.0}));
    entry("Center Here")->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !view().isMoving(); }, kTimeout));
    auto hit = view().surfaceAt(middle());
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->grid.column, 25.0, 0.3);
    EXPECT_NEAR(hit->grid.row, 15.0, 0.3);
    EXPECT_NEAR(view().camera().distance_m, before, 0.2 * before);
    OrbitCamera farther = view().camera();
    farther.distance_m = 2.0 * before;
    view().setCamera(farther);
    rightClick(placeOf({30.0, 20.0}));
    entry("Fly Here")->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !view().isMoving(); }, kTimeout));
    hit = view().surfaceAt(middle());
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->grid.column, 30.0, 0.3);
    EXPECT_NEAR(hit->grid.row, 20.0, 0.3);
    EXPECT_LT(view().camera().distance_m, 1.5 * before);
    // No nearer than where a sample, 30 m wide, is 8 points large.
    EXPECT_NEAR(view().metersPerPoint(*hit), 30.0 / 8.0, 0.2);
}

TEST_F(MapMenuTest, RemovesThePinOfAPlaceThatWasFound)
{
    rightClick(placeOf({25.0, 15.0}));
    EXPECT_EQ(entry("Remove Pin"), nullptr);
    window_->overlays()->markPlace(GridPoint{20.0, 12.0});
    rightClick(placeOf({25.0, 15.0}));
    ASSERT_NE(entry("Remove Pin"), nullptr);
    entry("Remove Pin")->trigger();
    EXPECT_FALSE(window_->overlays()->isPlaceMarked());
}

TEST_F(MapMenuTest, WhatIsHereDoesNotDependOnTheExaggeration)
{
    for (const double exaggeration : {1.0, 7.0}) {
        view().setExaggeration(exaggeration);
        rightClick(placeOf({20.0, 12.0}));
        entry("What Is Here…")->trigger();
        ASSERT_NE(card(), nullptr);
        EXPECT_TRUE(card()->isVisible());
        EXPECT_FALSE(card()->isModal());
        // A new tool window gets no focus under openbox, no new window without a window manager.
        EXPECT_TRUE(waitFor([&] { return card()->isActiveWindow(); }));
        EXPECT_EQ(fact(QStringLiteral("Layer")), QStringLiteral("plane.asc"));
        EXPECT_EQ(fact(QStringLiteral("Sample")), QStringLiteral("column 20, row 12"));
        EXPECT_TRUE(fact(QStringLiteral("Elevation")).startsWith(QStringLiteral("1,084")) ||
                    fact(QStringLiteral("Elevation")).startsWith(QStringLiteral("1084")))
            << fact(QStringLiteral("Elevation")).toStdString();
        // Rises by 0.2 eastward and 0.1 northward: atan of the square root of 0.05, facing west by
        // south.
        EXPECT_EQ(fact(QStringLiteral("Slope")), QStringLiteral("12.6°"));
        EXPECT_EQ(fact(QStringLiteral("Aspect")), QStringLiteral("243° (SW)"));
        card()->findChild<QPushButton*>(QStringLiteral("copyAll"))->click();
        const QString text = QGuiApplication::clipboard()->text();
        EXPECT_TRUE(text.contains(QStringLiteral("Slope: 12.6°"))) << text.toStdString();
        EXPECT_TRUE(text.contains(QStringLiteral("Sample: column 20, row 12")));
        card()->close();
    }
}

// The lower left corner of the grid of 30 m is at (500000, 4000000); the map has no CRS.
TEST_F(MapMenuTest, MeasuresAndAnnotatesFromTheClickedPlace)
{
    const auto at = [&](const std::vector<DrawnVertex>& vertices, std::size_t index) {
        return index < vertices.size()
                   ? view().map()->georeference().toGrid(std::get<MapPoint>(vertices[index]))
                   : GridPoint{};
    };
    MeasureController& measuring = *window_->measuring();
    rightClick(placeOf({20.0, 12.0}));
    entry("Measure Distance from Here")->trigger();
    ASSERT_NE(measuring.current(), nullptr);
    EXPECT_EQ(measuring.current()->kind, MeasurementKind::Distance);
    EXPECT_NEAR(at(measuring.current()->vertices, 0).column, 20.0, 0.1);
    EXPECT_NEAR(at(measuring.current()->vertices, 0).row, 12.0, 0.1);
    EXPECT_TRUE(view().hasFocus()) << "Enter and Escape are for the tool";
    // The next click goes on from there.
    ASSERT_TRUE(waitFor([&] { return window_->measurePanel()->isVisible(); }));
    QTest::mouseClick(&view(), Qt::LeftButton, {}, placeOf({26.0, 12.0}).toPoint());
    EXPECT_NEAR(at(measuring.current()->vertices, 1).column, 26.0, 0.5);

    AnnotationController& annotating = *window_->annotating();
    rightClick(placeOf({22.0, 14.0}));
    entry("Add Annotation Here")->trigger();
    ASSERT_EQ(annotating.state().items.size(), 1U);
    EXPECT_NEAR(at(annotating.state().items.back().vertices, 0).column, 22.0, 0.1);
    EXPECT_NEAR(at(annotating.state().items.back().vertices, 0).row, 14.0, 0.1);
}

// Of a place in the lower right corner of the screen too.
TEST_F(MapMenuTest, TheCardStaysOnTheScreen)
{
    const QRect screen = window_->screen()->availableGeometry();
    window_->move(screen.bottomRight() - view().mapTo(window_.get(), middle().toPoint()) -
                  QPoint(40, 40));
    ASSERT_TRUE(
        waitFor([&] { return screen.bottom() - view().mapToGlobal(middle()).y() < 100.0; }));
    rightClick(middle());
    entry("What Is Here…")->trigger();
    ASSERT_NE(card(), nullptr);
    EXPECT_TRUE(screen.contains(card()->frameGeometry()));
}

TEST_F(MapMenuTest, OpensInTheMiddleByKeyboard)
{
    const auto here = view().surfaceAt(middle());
    ASSERT_TRUE(here);
    QTest::keyClick(&view(), Qt::Key_F10, Qt::ShiftModifier);
    ASSERT_NE(menu(), nullptr);
    entry("Copy Elevation")->trigger();
    EXPECT_NEAR(QGuiApplication::clipboard()->text().toDouble(), here->height_m, 0.2);
    delete menu();
    QContextMenuEvent key(QContextMenuEvent::Keyboard, {1, 1}, view().mapToGlobal(QPoint(1, 1)),
                          Qt::NoModifier);
    QApplication::sendEvent(&view(), &key);
    EXPECT_NE(menu(), nullptr);
}

TEST_F(MapMenuTest, OffersNothingOutsideTheTerrain)
{
    OrbitCamera low = view().camera();
    low.tilt = Angle::degrees(85.0);
    view().setCamera(low);
    rightClick({view().width() / 2.0, 4.0});
    ASSERT_NE(menu(), nullptr);
    for (const QAction* action : menu()->actions()) {
        EXPECT_TRUE(action->isSeparator() || !action->isEnabled()) << action->text().toStdString();
    }
}

TEST_F(MapMenuTest, OffersCoordinatesWhereTheMapHasNoData)
{
    const TestMaps::Shape apart{.x_lower_left = 800000.0};
    const QString hollow =
        maps_.write(QStringLiteral("hollow.asc"), apart, [](int column, int row) {
            return std::hypot(column - 29.5, row - 19.5) < 8.0 ? std::nan("") : 100.0;
        });
    ASSERT_TRUE(openAndWait(*window_, hollow));
    rightClick(middle());
    ASSERT_NE(menu(), nullptr);
    EXPECT_TRUE(entry("Copy Coordinates")->isEnabled());
    EXPECT_TRUE(entry("Center Here")->isEnabled());
    EXPECT_FALSE(entry("Copy Elevation")->isEnabled());
}

TEST_F(MapMenuTest, TheCardOutlivesItsLayer)
{
    rightClick(placeOf({20.0, 12.0}));
    entry("What Is Here…")->trigger();
    ASSERT_NE(card(), nullptr);
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    window_->controller().remove(window_->session().layers.back().id);
    QCoreApplication::processEvents();
    EXPECT_EQ(fact(QStringLiteral("Layer")), QStringLiteral("plane.asc"));
}

} // namespace
} // namespace marsview
