#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"
#include "ui/dialogs/go_to_dialog.h"
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/place_mark.h"
#include "ui/panels/layers_panel.h"
#include "ui/window/status_readout.h"
#include "ui/window/window_actions.h"

#include <QApplication>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QLabel>
#include <QLineEdit>
#include <QLineF>
#include <QListView>
#include <QLocale>
#include <QPushButton>
#include <QTest>

#include <gtest/gtest.h>

namespace marsview {
namespace {

using D = ReadAs;

class GoToDialogTest : public testing::Test {
protected:
    std::shared_ptr<const Map> load(const QString& file)
    {
        JobMonitor monitor;
        return *readMap(RasterSpec{.path = file.toStdString()}, monitor, std::size_t{1} << 24);
    }

    TestMaps maps_;
};

TEST_F(GoToDialogTest, FindsThePlaceInEveryKindOfCoordinate)
{
    const auto mars = load(maps_.mars()); // 10° E, 20° N, a quarter of a degree per pixel
    const auto at = [&](D display, const char* text) {
        const auto place = placeOnMap(mars, {}, display, QString::fromUtf8(text));
        EXPECT_TRUE(place) << text << ": " << (place ? "" : place.error().message);
        return place ? place->grid : GridPoint{-1, -1};
    };
    for (const char* text :
         {"15 N 12.5 E", "15, 12.5", "12.5 E 15 N", "15, -347.5", "15°00′ N 347°30′ W"}) {
        const GridPoint grid = at(D::Planetocentric, text);
        EXPECT_NEAR(grid.column, 9.5, 1e-9) << text;
        EXPECT_NEAR(grid.row, 19.5, 1e-6) << text;
    }
    const GridPoint map = at(D::Map, "12.5, 15");
    EXPECT_NEAR(map.column, 9.5, 1e-9);
    // The outer half pixel belongs to the map; the place is the one typed.
    EXPECT_EQ(at(D::Map, "10.0, 20.0"), (GridPoint{-0.5, -0.5}));
}

TEST_F(GoToDialogTest, DistinguishesTheKindsOfLatitude)
{
    // On the flattened Mars they differ by 0.17° at 15°: two thirds of a pixel.
    const auto mars =
        load(maps_.placed("flat", "IAU_2015:49902", {10.0, 0.25, 0.0, 20.0, 0.0, -0.25}));
    const auto row = [&mars](D display) {
        return placeOnMap(mars, {}, display, QStringLiteral("15, 12.5"))->grid.row;
    };
    const double ratio = 3376.2 / 3396.19;
    const double graphic = std::atan(std::tan(Angle::degrees(15.0).radians()) / (ratio * ratio));
    EXPECT_NEAR(row(D::Planetocentric) - row(D::Planetographic),
                -(Angle::radians(graphic).degrees() - 15.0) / 0.25, 0.02);
}

TEST_F(GoToDialogTest, UnderstandsEveryFormatForAnyChoice)
{
    const auto mars = load(maps_.mars());
    CoordinateFormat west;
    west.longitudes = LongitudeNotation::West360;
    const auto column = [&](const CoordinateFormat& format, D read_as, const char* text) {
        const auto place = placeOnMap(mars, format, read_as, QString::fromUtf8(text));
        EXPECT_TRUE(place) << text << ": " << (place ? "" : place.error().message);
        return place ? place->grid.column : -1.0;
    };
    EXPECT_NEAR(column(west, D::Planetocentric, "15, 347.5"), 9.5, 1e-6);
    EXPECT_NEAR(column(west, D::Planetocentric, "15 N, 12.5 E"), 9.5, 1e-6);
    EXPECT_NEAR(column({}, D::Planetocentric, "15° 00′ 00″ N, 347° 30′ 00″ W"), 9.5, 1e-6);
    EXPECT_NEAR(column({}, D::Planetocentric, "15,0 12,5"), 9.5, 1e-6);
    // Direction letters make it a latitude and a longitude even where x, y is expected.
    EXPECT_NEAR(column({}, D::Map, "15 N 12.5 E"), 9.5, 1e-6);
}

TEST_F(GoToDialogTest, AcceptsMapCoordinatesThatCannotBeDegrees)
{
    // UTM, 30 m, from 500 000 m east and 4 000 000 m north.
    const auto utm = load(maps_.placed("utm", "EPSG:32611", {5e5, 30, 0, 4e6, 0, -30}));
    QLocale::setDefault(QLocale(QLocale::English));
    for (const char* text : {"500615 3999385", "500615, 3999385", "500,615, 3,999,385 m"}) {
        const auto place = placeOnMap(utm, {}, D::Planetographic, QString::fromUtf8(text));
        ASSERT_TRUE(place) << text << ": " << place.error().message;
        EXPECT_EQ(place->read_as, D::Map) << text;
        EXPECT_NEAR(place->grid.column, 20.0, 1e-6) << text;
        EXPECT_NEAR(place->grid.row, 20.0, 1e-6) << text;
    }
    QLocale::setDefault(QLocale(QLocale::German));
    const auto german = placeOnMap(utm, {}, D::Map, QStringLiteral("500.615, 3.999.385 m"));
    ASSERT_TRUE(german) << german.error().message;
    EXPECT_NEAR(german->grid.column, 20.0, 1e-6);
    QLocale::setDefault(QLocale::c());
}

TEST_F(GoToDialogTest, ReadsBackWhatTheStatusBarShowsInEveryFormat)
{
    const auto earth =
        load(maps_.placed("earth", "EPSG:4326", {10.0, 0.25, 0.0, 20.0, 0.0, -0.25}));
    for (const QLocale::Language language :
         {QLocale::English, QLocale::German, QLocale::French, QLocale::Arabic}) {
        QLocale::setDefault(QLocale(language));
        for (int i = 0; i < 3 * 2 * 2; ++i) {
            CoordinateFormat format;
            format.longitudes = static_cast<LongitudeNotation>(i % 3);
            format.angles = static_cast<AngleNotation>(i / 3 % 2);
            format.setLatitudesOn(bodyNamed("Earth"), static_cast<LatitudeKind>(i / 6));
            const GridPoint grid{7.0, 11.0};
            const QString shown = positionText(format, *earth, grid);
            const auto place =
                placeOnMap(earth, format, readingsOn(earth->info(), format).front(), shown);
            ASSERT_TRUE(place) << shown.toStdString() << ": " << place.error().message;
            EXPECT_NEAR(place->grid.column, grid.column, 0.1) << shown.toStdString();
            EXPECT_NEAR(place->grid.row, grid.row, 0.1) << shown.toStdString();
        }
    }
    QLocale::setDefault(QLocale::c());
}

TEST_F(GoToDialogTest, NamesTheExtentOfTheMapForPlacesOutside)
{
    const auto mars = load(maps_.mars());
    const auto place = placeOnMap(mars, {}, D::Planetocentric, QStringLiteral("-50, 12"));
    ASSERT_FALSE(place);
    EXPECT_NE(place.error().message.find("outside the map"), std::string::npos);
    EXPECT_NE(place.error().message.find("12.5° N – 20.0° N, 10.0° E – 20.0° E"), std::string::npos)
        << place.error().message;
}

TEST_F(GoToDialogTest, SaysWhatNoMapCanHave)
{
    const auto mars = load(maps_.mars());
    const auto earth =
        load(maps_.placed("earth", "EPSG:4326", {10.0, 0.25, 0.0, 20.0, 0.0, -0.25}));
    for (const auto& maps : {std::vector{mars}, std::vector{mars, earth}}) {
        const auto place = placeOnMaps(maps, {}, D::Planetocentric, QStringLiteral("95 N 12 E"));
        ASSERT_FALSE(place);
        EXPECT_EQ(place.error().message, "latitude 95 is beyond 90 degrees");
    }
    const auto outside =
        placeOnMaps({mars, earth}, {}, D::Planetocentric, QStringLiteral("-50, 12"));
    ASSERT_FALSE(outside);
    EXPECT_EQ(outside.error().message, "This place is outside all maps in the view.");
}

// The place in the middle, which reads back.
TEST_F(GoToDialogTest, ShowsAnExampleOfTheMapsOwnCoordinates)
{
    const auto example = [](const std::shared_ptr<const Map>& map) {
        GoToDialog dialog({map}, {}, {.read_as = D::Map, .text = {}}, {});
        const QString text =
            dialog.findChild<QLineEdit*>(QStringLiteral("coordinate"))->placeholderText();
        const auto place = placeOnMap(map, {}, D::Map, text);
        EXPECT_TRUE(place) << text.toStdString();
        const GridPoint grid = place ? place->grid : GridPoint{-1, -1};
        EXPECT_NEAR(grid.column, 0.5 * static_cast<double>(map->info().columns - 1), 0.5);
        EXPECT_NEAR(grid.row, 0.5 * static_cast<double>(map->info().rows - 1), 0.5);
        return text;
    };
    const QString degrees =
        example(load(maps_.placed("earth", "EPSG:4326", {10.0, 0.25, 0.0, 20.0, 0.0, -0.25})));
    EXPECT_TRUE(degrees.startsWith(QStringLiteral("1"))) << degrees.toStdString();
    example(load(maps_.hill())); // 500 km east
}

TEST_F(GoToDialogTest, EnablesGoOnlyForValidText)
{
    GoToDialog dialog({load(maps_.mars())}, {}, {}, {});
    auto* field = dialog.findChild<QLineEdit*>(QStringLiteral("coordinate"));
    auto* answer = dialog.findChild<QLabel*>(QStringLiteral("answer"));
    auto* go = dialog.findChild<QDialogButtonBox*>()->buttons().constLast();
    for (QAbstractButton* button : dialog.findChild<QDialogButtonBox*>()->buttons()) {
        if (dialog.findChild<QDialogButtonBox*>()->buttonRole(button) ==
            QDialogButtonBox::AcceptRole) {
            go = button;
        }
    }
    EXPECT_FALSE(go->isEnabled());
    field->setText(QStringLiteral("15 N"));
    EXPECT_FALSE(go->isEnabled());
    EXPECT_TRUE(answer->text().contains(QStringLiteral("latitude and a longitude")));
    field->setText(QStringLiteral("15 N 12.5 E"));
    EXPECT_TRUE(go->isEnabled());
    EXPECT_TRUE(answer->text().startsWith(QStringLiteral("15.0")));
    EXPECT_TRUE(answer->text().contains(QStringLiteral(" m")));
}

TEST_F(GoToDialogTest, FliesThereAndRemembersTheText)
{
    MainWindow window(testWindowOptions());
    window.resize(1280, 800);
    window.show();
    ASSERT_TRUE(openAndWait(window, maps_.mars()));
    for (int round = 0; round < 2; ++round) {
        window.actionSet().go_to_place->trigger();
        auto* dialog = window.findChild<GoToDialog*>();
        ASSERT_NE(dialog, nullptr);
        auto* field = dialog->findChild<QLineEdit*>(QStringLiteral("coordinate"));
        if (round == 0) {
            field->setText(QStringLiteral("17 N 13 E"));
            QTest::keyClick(field, Qt::Key_Return);
            ASSERT_TRUE(
                QTest::qWaitFor([&] { return window.view()->isPictureComplete(); }, kTimeout));
            const OrbitCamera& camera = window.view()->camera();
            const GridPoint target =
                window.view()->map()->georeference().sceneFrame().toGrid(camera.target);
            EXPECT_NEAR(target.column, 11.5, 0.01);
            EXPECT_NEAR(target.row, 11.5, 0.01);
            ASSERT_TRUE(QTest::qWaitFor([&] { return window.findChild<GoToDialog*>() == nullptr; },
                                        kTimeout));
        } else {
            EXPECT_EQ(field->text(), QStringLiteral("17 N 13 E"));
        }
    }
}

// By mouse and by keyboard: the map has the focus, the place a pin, and the status bar reads it.
TEST_F(GoToDialogTest, MarksThePlaceUntilDismissed)
{
    MainWindow window(testWindowOptions());
    window.resize(1280, 800);
    window.show();
    QApplication::setActiveWindow(&window); // there is no window manager
    ASSERT_TRUE(openAndWait(window, maps_.mars()));
    TerrainView& view = *window.view();
    const PlaceMark& mark = *window.overlays()->placeMark();
    const auto soon = [](auto condition) { return QTest::qWaitFor(condition, kTimeout); };
    for (const bool is_by_mouse : {true, false}) {
        SCOPED_TRACE(is_by_mouse ? "mouse" : "keyboard");
        window.datasetPanel()->list()->setFocus();
        QTest::mouseMove(&view, view.rect().center() + QPoint(60, 40));
        EXPECT_FALSE(mark.isVisible());
        window.actionSet().go_to_place->trigger();
        auto* dialog = window.findChild<GoToDialog*>();
        ASSERT_NE(dialog, nullptr);
        auto* field = dialog->findChild<QLineEdit*>(QStringLiteral("coordinate"));
        field->setText(QStringLiteral("17 N 13 E"));
        if (is_by_mouse) {
            for (auto* button : dialog->findChildren<QPushButton*>()) {
                if (button->isDefault()) {
                    QTest::mouseClick(button, Qt::LeftButton);
                }
            }
        } else {
            QTest::keyClick(field, Qt::Key_Return);
        }
        ASSERT_TRUE(soon([&] { return window.findChild<GoToDialog*>() == nullptr; }));
        QApplication::setActiveWindow(&window);
        ASSERT_TRUE(soon([&] { return !view.isMoving() && view.isPictureComplete(); }));
        EXPECT_TRUE(view.hasFocus());
        ASSERT_TRUE(mark.isVisible());
        // 10° E, 20° N is the corner; samples are 0.25° apart, the first half of that inside.
        const QPointF place = view.positionOf({11.5, 11.5}).value();
        EXPECT_LT(QLineF(mark.tip(), place).length(), 1.0);
        EXPECT_LT(QLineF(mark.tip(), QRectF(view.rect()).center()).length(), 3.0);
        EXPECT_TRUE(soon([&] { return view.isCrosshairShown(); }));
        // As typed, and the elevation there: 20 m a column, from −300 m on.
        const QString position = window.readout()->coordinateLabel();
        EXPECT_TRUE(position.startsWith(QStringLiteral("17.00"))) << position.toStdString();
        EXPECT_TRUE(position.contains(QStringLiteral(" 13.00"))) << position.toStdString();
        EXPECT_TRUE(window.readout()->heightLabel().startsWith(QStringLiteral("−70")))
            << window.readout()->heightLabel().toStdString();
        // It stays on its place while people look around, and goes with a click or Esc.
        view.step(NavigationStep::PanLeft);
        ASSERT_TRUE(soon([&] { return !view.isMoving(); }));
        EXPECT_LT(QLineF(mark.tip(), view.positionOf({11.5, 11.5}).value()).length(), 1.0);
        if (is_by_mouse) {
            QTest::mouseClick(&view, Qt::LeftButton, {}, view.rect().center() + QPoint(90, 30));
        } else {
            QTest::keyClick(&view, Qt::Key_Escape);
        }
        EXPECT_FALSE(mark.isVisible());
    }
}

TEST_F(GoToDialogTest, ReadsInTheConventionOfTheBodyUnlessChosenOtherwise)
{
    const auto mars =
        load(maps_.placed("flat", "IAU_2015:49902", {10.0, 0.25, 0.0, 20.0, 0.0, -0.25}));
    const auto earth =
        load(maps_.placed("earth", "EPSG:4326", {10.0, 0.25, 0.0, 20.0, 0.0, -0.25}));
    const auto kind = [](const GoToDialog& dialog) {
        return static_cast<D>(dialog.findChild<QComboBox*>()->currentData().toInt());
    };
    const GoToDialog on_mars({mars}, {}, {}, {});
    EXPECT_EQ(kind(on_mars), D::Planetocentric);
    const GoToDialog on_earth({earth}, {}, on_mars.entry(), {});
    EXPECT_EQ(kind(on_earth), D::Planetographic);
    EXPECT_EQ(kind(GoToDialog({earth}, {}, {.read_as = D::Map, .text = {}}, {})), D::Map);
}

TEST_F(GoToDialogTest, OffersOnlyMapCoordinatesWithoutGeographicOnes)
{
    GoToDialog dialog({load(maps_.hill())}, {}, {}, {});
    auto* kinds = dialog.findChild<QComboBox*>();
    EXPECT_EQ(kinds->count(), 1);
    dialog.findChild<QLineEdit*>(QStringLiteral("coordinate"))
        ->setText(QStringLiteral("500600, 4000600"));
    EXPECT_TRUE(dialog.findChild<QLabel*>(QStringLiteral("answer"))
                    ->text()
                    .startsWith(QStringLiteral("500600")));
}

} // namespace
} // namespace marsview
