#include "tests/ui/test_map.h"
#include "ui/dialogs/go_to_dialog.h"
#include "ui/terrain_view.h"
#include "ui/window_actions.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTest>

#include <gtest/gtest.h>

namespace marsview {
namespace {

using D = CoordinateDisplay;

class GoToDialogTest : public testing::Test {
protected:
    std::shared_ptr<const Dataset> load(const QString& file)
    {
        JobMonitor monitor;
        return *loadDataset({.path = file.toStdString()}, monitor, std::size_t{1} << 24);
    }

    TestMaps maps_;
};

TEST_F(GoToDialogTest, FindsThePlaceInEveryKindOfCoordinate)
{
    const auto mars = load(maps_.mars()); // 10° E, 20° N, a quarter of a degree a pixel
    const auto at = [&](D display, const char* text) {
        const auto grid = placeOnMap(*mars, display, QString::fromUtf8(text));
        EXPECT_TRUE(grid) << text << ": " << (grid ? "" : grid.error().message);
        return grid ? *grid : GridPoint{-1, -1};
    };
    for (const char* text :
         {"15 N 12.5 E", "15, 12.5", "12.5 E 15 N", "15, -347.5", "15°00′ N 347°30′ W"}) {
        const GridPoint grid = at(D::Planetocentric, text);
        EXPECT_NEAR(grid.column, 9.5, 1e-9) << text;
        EXPECT_NEAR(grid.row, 19.5, 1e-6) << text;
    }
    const GridPoint map = at(D::Map, "12.5, 15");
    EXPECT_NEAR(map.column, 9.5, 1e-9);
    // The outer half pixel belongs to the map.
    EXPECT_EQ(at(D::Map, "10.0, 20.0"), (GridPoint{0.0, 0.0}));
}

TEST_F(GoToDialogTest, TellsTheKindsOfLatitudeApart)
{
    // On the flattened Mars they differ by 0.17° at 15°: two thirds of a pixel.
    const auto mars =
        load(maps_.placed("flat", "IAU_2015:49902", {10.0, 0.25, 0.0, 20.0, 0.0, -0.25}));
    const auto row = [&mars](D display) {
        return placeOnMap(*mars, display, QStringLiteral("15, 12.5"))->row;
    };
    const double ratio = 3376.2 / 3396.19;
    const double graphic = std::atan(std::tan(Angle::degrees(15.0).radians()) / (ratio * ratio));
    EXPECT_NEAR(row(D::Planetocentric) - row(D::Planetographic),
                -(Angle::radians(graphic).degrees() - 15.0) / 0.25, 0.02);
}

TEST_F(GoToDialogTest, SaysWhereTheMapIsWhenThePlaceIsElsewhere)
{
    const auto mars = load(maps_.mars());
    const auto place = placeOnMap(*mars, D::Planetocentric, QStringLiteral("-50, 12"));
    ASSERT_FALSE(place);
    EXPECT_NE(place.error().message.find("outside the map"), std::string::npos);
    EXPECT_NE(place.error().message.find("20.00° N 20.00° E"), std::string::npos)
        << place.error().message;
}

TEST_F(GoToDialogTest, AllowsToGoOnlyWhereItUnderstands)
{
    GoToDialog dialog(load(maps_.mars()), {});
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

TEST_F(GoToDialogTest, FliesThereAndRemembersWhatWasAsked)
{
    MainWindow window(testWindowOptions());
    window.resize(1280, 800);
    window.show();
    ASSERT_TRUE(openAndWait(window, maps_.mars()));
    for (int round = 0; round < 2; ++round) {
        window.actionSet().go_to_coordinate->trigger();
        auto* dialog = window.findChild<GoToDialog*>();
        ASSERT_NE(dialog, nullptr);
        auto* field = dialog->findChild<QLineEdit*>(QStringLiteral("coordinate"));
        if (round == 0) {
            field->setText(QStringLiteral("17 N 13 E"));
            QTest::keyClick(field, Qt::Key_Return);
            ASSERT_TRUE(QTest::qWaitFor([&] { return window.view()->isPictureComplete(); }, 10000));
            const OrbitCamera& camera = window.view()->camera();
            const GridPoint target =
                window.view()->map().dataset->georeference().sceneFrame().toGrid(camera.target);
            EXPECT_NEAR(target.column, 11.5, 0.01);
            EXPECT_NEAR(target.row, 11.5, 0.01);
            ASSERT_TRUE(
                QTest::qWaitFor([&] { return window.findChild<GoToDialog*>() == nullptr; }, 5000));
        } else {
            EXPECT_EQ(field->text(), QStringLiteral("17 N 13 E"));
        }
    }
}

TEST_F(GoToDialogTest, ReadsAsIsUsualOnTheBodyUnlessToldOtherwise)
{
    const auto mars =
        load(maps_.placed("flat", "IAU_2015:49902", {10.0, 0.25, 0.0, 20.0, 0.0, -0.25}));
    const auto earth =
        load(maps_.placed("earth", "EPSG:4326", {10.0, 0.25, 0.0, 20.0, 0.0, -0.25}));
    const auto kind = [](const GoToDialog& dialog) {
        return static_cast<D>(dialog.findChild<QComboBox*>()->currentData().toInt());
    };
    const GoToDialog on_mars(mars, {});
    EXPECT_EQ(kind(on_mars), D::Planetocentric);
    const GoToDialog on_earth(earth, on_mars.entry());
    EXPECT_EQ(kind(on_earth), D::Planetographic);
    EXPECT_EQ(kind(GoToDialog(earth, {.display = D::Map, .text = {}})), D::Map);
}

TEST_F(GoToDialogTest, OffersMapCoordinatesOnlyWhereThereAreNoOthers)
{
    GoToDialog dialog(load(maps_.hill()), {});
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
