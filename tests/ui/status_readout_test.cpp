#include "tests/ui/map_window.h"
#include "tests/ui/pointer_moves.h"
#include "ui/commands/window_commands.h"
#include "ui/overlay/crosshair.h"
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/minimap.h"
#include "ui/panels/layers_panel.h"
#include "ui/widgets/coordinate_field.h"
#include "ui/window/status_readout.h"
#include "ui/window/window_actions.h"

#include <QAbstractButton>
#include <QApplication>
#include <QClipboard>
#include <QEnterEvent>
#include <QLocale>
#include <QMenu>
#include <QTest>
#include <QToolButton>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

class StatusReadoutTest : public MapWindowTest {
protected:
    void SetUp() override { makeWindow(kWithPanels); }

    StatusReadout& readout() { return *window_->readout(); }
    bool isRead(const QString& coordinates)
    {
        return QTest::qWaitFor([&] { return readout().coordinateLabel() == coordinates; },
                               kTimeout);
    }
    // On the terrain, away from every overlay.
    void pointAtTheMiddle()
    {
        ASSERT_TRUE(movePointer(view(), view().rect().center()));
        ASSERT_TRUE(QTest::qWaitFor([&] { return !readout().heightLabel().isEmpty(); }, kTimeout));
    }
    QAction* choice(const QString& text)
    {
        menu_.clear();
        readout().fillMenu(menu_);
        for (QAction* action : menu_.actions()) {
            if (action->text() == text) {
                return action;
            }
        }
        return nullptr;
    }
    QString positionOfTheMiddle() { return positionAt(middle()); }
    QString positionAt(QPointF place)
    {
        const auto hit = view().surfaceAt(place);
        return hit ? positionText(readout().format(), *view().map(), hit->grid,
                                  view().metersPerPoint(*hit))
                   : QString();
    }

    QMenu menu_;
};

TEST_F(StatusReadoutTest, ShowsNoElevationWhileThePointerIsOverAnOverlay)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    window_->datasetPanel()->setFocus(); // no crosshair
    ASSERT_NO_FATAL_FAILURE(pointAtTheMiddle());
    QWidget* minimap = window_->overlays()->minimap();
    ASSERT_TRUE(minimap->isVisible());
    QEnterEvent enter(QPointF(5, 5), QPointF(5, 5), QPointF(5, 5));
    QApplication::sendEvent(minimap, &enter);
    EXPECT_TRUE(readout().heightLabel().isEmpty());
    // Move events on an overlay that ignores them reach the map behind it.
    QTest::mouseMove(&view(), minimap->geometry().center());
    QMouseEvent move(QEvent::MouseMove, minimap->geometry().center(),
                     view().mapToGlobal(minimap->geometry().center()), Qt::NoButton, Qt::NoButton,
                     Qt::NoModifier);
    QApplication::sendEvent(&view(), &move);
    EXPECT_TRUE(readout().heightLabel().isEmpty());
}

TEST_F(StatusReadoutTest, ReadsTheMiddleOfThePictureForTheKeyboard)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    const QWidget* crosshair = window_->overlays()->crosshair();
    view().setFocus();
    leaveTheMap();
    EXPECT_TRUE(view().isCrosshairShown());
    EXPECT_TRUE(crosshair->isVisible());
    EXPECT_EQ(crosshair->geometry().center(), view().rect().center());
    ASSERT_FALSE(positionOfTheMiddle().isEmpty());
    EXPECT_TRUE(isRead(positionOfTheMiddle()));
    EXPECT_FALSE(readout().heightLabel().isEmpty());
    EXPECT_EQ(readout().sourceLabel(), QStringLiteral("Center"));

    // The pointer takes over when it moves, and a navigation key hands back to the middle.
    ASSERT_NO_FATAL_FAILURE(pointAtTheMiddle());
    EXPECT_EQ(readout().sourceLabel(), QStringLiteral("Pointer"));
    EXPECT_FALSE(crosshair->isVisible());
    QTest::keyClick(&view(), Qt::Key_Left);
    EXPECT_TRUE(crosshair->isVisible());
    ASSERT_TRUE(QTest::qWaitFor([&] { return !view().isMoving(); }, kTimeout));
    EXPECT_TRUE(isRead(positionOfTheMiddle()));

    leaveTheMap();
    window_->datasetPanel()->setFocus();
    EXPECT_FALSE(crosshair->isVisible());
    EXPECT_EQ(readout().coordinateLabel(), QStringLiteral("outside the map"));
    EXPECT_EQ(readout().sourceLabel(), QStringLiteral("Pointer"));
    readout().coordinateField()->setFocus(Qt::TabFocusReason);
    EXPECT_TRUE(crosshair->isVisible());
}

// Straight down, a pixel shows the same place of the map at any elevation.
TEST_F(StatusReadoutTest, ReadsWhereTheMapHasNoData)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.ring()));
    OrbitCamera camera = view().camera();
    camera.target.x = 0.0; // the middle of the hole
    camera.target.y = 0.0;
    camera.tilt = {};
    view().setCamera(camera);
    ASSERT_TRUE(waitUntilSettled(*window_));
    ASSERT_TRUE(movePointer(view(), view().rect().center()));
    const QPointF from_center = QPointF(view().rect().center()) - middle();
    const double point_m = view().metersPerPoint(RayHit{.grid = {29.5, 19.5}, .height_m = NAN});
    const GridPoint there{29.5 + from_center.x() * point_m / 30.0,
                          19.5 + from_center.y() * point_m / 30.0};
    EXPECT_TRUE(isRead(positionText(readout().format(), *view().map(), there, point_m)));
    EXPECT_EQ(readout().heightLabel(), QStringLiteral("no data"));
}

TEST_F(StatusReadoutTest, ReadsThePlaceUnderTheStylusOfADevice)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    window_->datasetPanel()->setFocus(); // no crosshair
    leaveTheMap();
    const Map& mars = *view().map();
    StylusPose pose;
    pose.is_in_contact = true;
    // Elevations are 20 m a column, from −300 m on.
    for (const double column : {30.0, 12.0}) {
        pose.proxy = mars.georeference().sceneFrame().toScene(
            {column, 8.0}, (20.0 * column - 300.0) * view().exaggeration());
        view().showDevice(pose);
        EXPECT_EQ(readout().coordinateLabel(),
                  positionText(readout().format(), mars, {column, 8.0},
                               view().metersPerPoint(*view().reading())));
        EXPECT_TRUE(readout().heightLabel().startsWith(numberText(20.0 * column - 300.0, 0)))
            << readout().heightLabel().toStdString();
    }
    EXPECT_EQ(readout().sourceLabel(), QStringLiteral("Stylus"));
    const QString under_stylus = readout().coordinateLabel();
    // The pointer is read while it moves, and the stylus again a while after it has come to rest.
    pointAtTheMiddle();
    EXPECT_TRUE(isRead(positionAt(view().rect().center())));
    EXPECT_TRUE(isRead(under_stylus));
    leaveTheMap();
    view().showDevice(std::nullopt);
    EXPECT_TRUE(readout().heightLabel().isEmpty());
}

TEST_F(StatusReadoutTest, CopiesThePositionByKeysAndByAClick)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    view().setFocus();
    leaveTheMap();
    const QString position = positionOfTheMiddle();
    ASSERT_TRUE(isRead(position));
    QClipboard& clipboard = *QGuiApplication::clipboard();
    CoordinateField& field = *readout().coordinateField();
    const auto is_copied = [&] {
        const bool is = clipboard.text() == position;
        clipboard.clear();
        return is;
    };
    clipboard.clear();
    window_->actionSet().copy_coordinates->trigger();
    EXPECT_TRUE(is_copied());
    EXPECT_EQ(readout().coordinateLabel(), QStringLiteral("Copied"));
    EXPECT_TRUE(isRead(position)); // again, after a moment
    QTest::mouseClick(&field, Qt::LeftButton);
    EXPECT_TRUE(is_copied());
    EXPECT_TRUE(view().hasFocus());
    field.setFocus(Qt::TabFocusReason);
    QTest::keyClick(&field, Qt::Key_C, Qt::ControlModifier);
    EXPECT_TRUE(is_copied());
}

TEST_F(StatusReadoutTest, CopiesMapCoordinatesThatOtherProgramsRead)
{
    QLocale::setDefault(QLocale(QLocale::German));
    ASSERT_TRUE(
        openAndWait(*window_, maps_.placed("utm", "EPSG:32611", {5e5, 30, 0, -4e6, 0, -30})));
    CoordinateFormat format = readout().format();
    format.system = PositionSystem::Map;
    Q_EMIT readout().formatChosen(format);
    EXPECT_EQ(positionText(readout().format(), *view().map(), {9.5, 9.5}),
              QStringLiteral("500.300, −4.000.300 m"));
    window_->commands().places.copyCoordinates(GridPoint{9.5, 9.5});
    EXPECT_EQ(QGuiApplication::clipboard()->text(), QStringLiteral("500300, -4000300"));
    QLocale::setDefault(QLocale::c());
}

TEST_F(StatusReadoutTest, KeepsTheKindOfLatitudeOfEachBody)
{
    ASSERT_TRUE(openAndWait(
        *window_, maps_.placed("flat", "IAU_2015:49902", {10.0, 0.25, 0.0, 20.0, 0.0, -0.25})));
    QAction* graphic = choice(QStringLiteral("Planetographic"));
    ASSERT_NE(graphic, nullptr);
    graphic->trigger();
    EXPECT_EQ(window_->preferences().coordinates.latitudesOn(bodyNamed("Mars")),
              LatitudeKind::Planetographic);
    QAction* centric = choice(QStringLiteral("Planetocentric"));
    ASSERT_NE(centric, nullptr);
    centric->trigger();

    // The two kinds of latitude differ by 21 km at 45° on the Earth.
    ASSERT_TRUE(openAndWait(
        *window_, maps_.placed("tile", "EPSG:4326", {10.0, 0.01, 0.0, 45.15, 0.0, -0.01})));
    readout().setPlace(ReadPlace{.hit = {.grid = {14.5, 14.5}}});
    EXPECT_TRUE(readout().coordinateLabel().startsWith(QStringLiteral("45.000")))
        << readout().coordinateLabel().toStdString();
    EXPECT_NE(choice(QStringLiteral("Geodetic")), nullptr);
}

TEST_F(StatusReadoutTest, KeepsItsPartsInPlaceWhileNumbersChange)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    for (const auto notation :
         {AngleNotation::DecimalDegrees, AngleNotation::DegreesMinutesSeconds}) {
        CoordinateFormat format;
        format.angles = notation;
        Q_EMIT readout().formatChosen(format);
        QTest::qWait(0);
        const auto places_now = [this] {
            QList<QRect> places;
            for (const QWidget* part :
                 readout().findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly)) {
                places.append(part->geometry());
            }
            return places;
        };
        const QList<QRect> before = places_now();
        for (const GridPoint grid :
             {GridPoint{0.0, 0.0}, GridPoint{39.0, 29.0}, GridPoint{17.3, 11.1}}) {
            readout().setPlace(ReadPlace{.hit = {.grid = grid, .height_m = -1.0}});
            QTest::qWait(0);
            EXPECT_EQ(places_now(), before);
        }
        readout().setPlace(std::nullopt);
        QTest::qWait(0);
        EXPECT_EQ(places_now(), before);
    }
}

// The first picture of a map may take so long that people see what the readout is before it.
TEST_F(StatusReadoutTest, HasItsWidthsAndClaimsNoDetailBeforeTheFirstPicture)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    StatusReadout readout;
    readout.resize(1000, 30);
    readout.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&readout));
    readout.setDetail(0.0); // of a picture without a map
    readout.setMaps(view().map(), view().map());
    auto* format = readout.findChild<QToolButton*>(QStringLiteral("coordinateFormat"));
    ASSERT_NE(format, nullptr);
    EXPECT_GE(format->width(), format->sizeHint().width());
    EXPECT_EQ(readout.detailLabel(), QStringLiteral("loading…"));
    EXPECT_EQ(readout.coordinateLabel(), QString()) << "no place has been read";
    readout.setPlace(std::nullopt);
    EXPECT_EQ(readout.coordinateLabel(), QStringLiteral("outside the map"));
    readout.setDetail(0.0);
    EXPECT_EQ(readout.detailLabel(), QStringLiteral("full detail"));
}

TEST_F(StatusReadoutTest, HasEvenGapsAndOneButton)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    QTest::qWait(0);
    QList<QRect> places;
    for (const QWidget* part :
         readout().findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly)) {
        if (part->isVisible() && qobject_cast<const QMenu*>(part) == nullptr) {
            places.append(part->geometry());
        }
    }
    std::sort(places.begin(), places.end(),
              [](const QRect& a, const QRect& b) { return a.left() < b.left(); });
    ASSERT_EQ(places.size(), 7); // source, position, format, rule, elevation, rule, detail
    for (qsizetype i = 1; i < places.size(); ++i) {
        EXPECT_EQ(places[i].left() - places[i - 1].right(), places[1].left() - places[0].right());
    }
    EXPECT_EQ(readout().findChildren<QAbstractButton*>().size(), 1);
}

} // namespace
} // namespace marsview
