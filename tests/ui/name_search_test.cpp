// Finding places by name: the search field, Go to Place, files of names.
#include "tests/support/shared_data.h"
#include "tests/ui/map_window.h"
#include "ui/commands/name_search.h"
#include "ui/commands/window_commands.h"
#include "ui/dialogs/go_to_dialog.h"
#include "ui/overlay/map_labels.h"
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/place_mark.h"
#include "ui/window/main_tool_bar.h"
#include "ui/window/window_actions.h"

#include <QAbstractItemView>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScreen>
#include <QTest>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace marsview {
namespace {

class NameSearchTest : public MapWindowTest {
protected:
    static constexpr QSize kWide{1600, 900};

    void openMars()
    {
        makeWindow(kWide);
        ASSERT_TRUE(openAndWait(*window_, QString::fromStdString(test::bundledMars())));
    }
    QLineEdit& field() { return window_->toolBar()->searchField(); }
    NameCompleter& completer() { return *field().findChild<NameCompleter*>(); }
    QStringList listed(NameCompleter& completer)
    {
        QStringList rows;
        for (int i = 0; i < completer.model()->rowCount(); ++i) {
            rows.append(completer.model()->index(i, 0).data().toString());
        }
        return rows;
    }
    // The flight is over.
    bool isThere() { return window_->overlays()->isPlaceMarked() && !view().isMoving(); }
    // The position in degrees that the camera looks at when it has come to rest.
    GeographicPoint target()
    {
        const Georeference& map = view().map()->georeference();
        return *map.toGeographic(map.sceneFrame().toGrid(view().cameraGoal().target));
    }
};

TEST_F(NameSearchTest, TypingANameFliesThereSoThatTheFeatureFillsTheView)
{
    openMars();
    window_->actionSet().find_name->trigger();
    ASSERT_TRUE(waitFor([this] { return field().hasFocus(); }));
    QTest::keyClicks(&field(), QStringLiteral("olympus mo"));
    ASSERT_TRUE(waitFor([this] { return completer().popup()->isVisible(); }));
    EXPECT_EQ(listed(completer()).first().toStdString(), "Olympus Mons — mountain, 610 km");
    QTest::keyClick(&field(), Qt::Key_Return);
    EXPECT_TRUE(waitFor([this] { return isThere(); }));
    EXPECT_EQ(window_->focusWidget(), &view()); // so that keys move the map
    EXPECT_NEAR(target().latitude.degrees(), 18.65, 1e-6);
    EXPECT_NEAR(wrapLongitude(target().longitude, LongitudeRange::From0To360).degrees(), 226.2,
                1e-6);
    EXPECT_TRUE(window_->overlays()->isPlaceMarked());
    EXPECT_TRUE(field().text().isEmpty());
    // 2026-11: the pin covered the name.
    const auto* pin = view().findChild<PlaceMark*>();
    ASSERT_NE(pin, nullptr);
    EXPECT_TRUE(waitFor([&] {
        const auto& names = window_->overlays()->labels()->nameLabels();
        return std::any_of(names.begin(), names.end(), [&](const MapLabels::Label& name) {
            return name.text == QStringLiteral("Olympus Mons") &&
                   !name.box.intersects(QRectF(pin->geometry()));
        });
    }));
    // 610 km take between half and all of the picture's height.
    const double height_m =
        metersPerPixel(view().camera(), view().viewport()) * view().viewport().height;
    EXPECT_GT(610e3 / height_m, 0.5);
    EXPECT_LT(610e3 / height_m, 1.0);
}

// Airy-0 is 500 m wide, a pixel of the map 15 km.
TEST_F(NameSearchTest, AFeatureBelowTheMapsResolutionIsShownWithItsSurroundings)
{
    openMars();
    field().setFocus();
    QTest::keyClicks(&field(), QStringLiteral("airy-0"));
    ASSERT_TRUE(waitFor([this] { return completer().popup()->isVisible(); }));
    QTest::keyClick(&field(), Qt::Key_Return);
    EXPECT_TRUE(waitFor([this] { return isThere(); }));
    EXPECT_NEAR(target().latitude.degrees(), -5.07, 0.1);
    const double height_m =
        metersPerPixel(view().camera(), view().viewport()) * view().viewport().height;
    EXPECT_GT(height_m, 20.0 * 14818.0);
    EXPECT_LT(height_m, 60.0 * 14818.0);
}

// Return goes to the first name although the list is open, and only once.
TEST_F(NameSearchTest, ReturnInTheDialogTakesTheFirstName)
{
    openMars();
    GoToDialog dialog({view().map()}, window_->preferences(), {},
                      window_->commands().names.namesOnMap());
    std::vector<std::string> chosen;
    QObject::connect(&dialog, &GoToDialog::nameChosen, &dialog,
                     [&chosen](const PlaceName& place) { chosen.push_back(place.name); });
    dialog.show();
    QApplication::setActiveWindow(&dialog);
    auto* typed = dialog.findChild<QLineEdit*>(QStringLiteral("coordinate"));
    typed->setFocus();
    QTest::keyClicks(typed, QStringLiteral("olympus mo"));
    QWidget* list = typed->findChild<NameCompleter*>()->popup();
    ASSERT_TRUE(waitFor([&] { return list->isVisible(); }));
    QTest::keyClick(list, Qt::Key_Return);
    ASSERT_TRUE(waitFor([&] { return !dialog.isVisible(); }));
    EXPECT_EQ(chosen, std::vector<std::string>{"Olympus Mons"});
}

TEST_F(NameSearchTest, TheListIsChosenWithKeysAndMouse)
{
    openMars();
    field().setFocus();
    QTest::keyClicks(&field(), QStringLiteral("ascraeus m"));
    ASSERT_TRUE(waitFor([this] { return completer().popup()->isVisible(); }));
    const QStringList rows = listed(completer());
    ASSERT_GE(rows.size(), 2);
    const qsizetype row = rows.indexOf(QStringLiteral("Ascraeus Mons — mountain, 456 km"));
    ASSERT_GE(row, 0) << rows.join(u'\n').toStdString();
    for (qsizetype i = 0; i <= row; ++i) {
        QTest::keyClick(completer().popup(), Qt::Key_Down);
    }
    QTest::keyClick(completer().popup(), Qt::Key_Return);
    EXPECT_TRUE(waitFor([this] { return isThere(); }));
    EXPECT_NEAR(target().latitude.degrees(), 11.92, 0.5);

    QApplication::setActiveWindow(window_.get());
    window_->overlays()->clearMark();
    field().setFocus();
    QTest::keyClicks(&field(), QStringLiteral("gale"));
    ASSERT_TRUE(waitFor([this] { return completer().popup()->isVisible(); }));
    QAbstractItemView* popup = completer().popup();
    QTest::mouseClick(popup->viewport(), Qt::LeftButton, {},
                      popup->visualRect(popup->model()->index(0, 0)).center());
    EXPECT_TRUE(waitFor([this] { return isThere(); }));
    EXPECT_NEAR(target().latitude.degrees(), -5.37, 0.1);
}

// The field is at the right end of the tool bar, and narrower than the list.
TEST_F(NameSearchTest, TheListOfAWindowAtTheEdgeOfTheScreenIsOnTheScreen)
{
    openMars();
    const QRect screen = window_->screen()->availableGeometry();
    window_->resize(1280, 700);
    window_->move(screen.right() - window_->width(), screen.top());
    ASSERT_TRUE(waitFor(
        [&] { return field().mapToGlobal(QPoint(field().width(), 0)).x() > screen.right() - 60; }));
    QTest::keyClicks(&field(), QStringLiteral("a"));
    ASSERT_TRUE(waitFor([this] { return completer().popup()->isVisible(); }));
    QTest::keyClicks(&field(), QStringLiteral("s"));
    const QRect list = completer().popup()->geometry();
    ASSERT_GT(list.width(), field().width());
    EXPECT_LE(list.right(), screen.right());
    EXPECT_GE(list.left(), screen.left());
}

TEST_F(NameSearchTest, AMisspelledNameGetsASuggestion)
{
    openMars();
    QTest::keyClicks(&field(), QStringLiteral("olimpus mons"));
    const QStringList rows = listed(completer());
    ASSERT_EQ(rows.size(), 2);
    EXPECT_EQ(rows[0].toStdString(), "No place on Mars is named “olimpus mons”.");
    EXPECT_EQ(rows[1].toStdString(), "Did you mean “Olympus Mons”?");
    QTest::keyClick(&field(), Qt::Key_Return); // does nothing
    EXPECT_FALSE(window_->overlays()->isPlaceMarked());
}

TEST_F(NameSearchTest, CoordinatesAreReferredToTheDialogThatTakesThem)
{
    openMars();
    QTest::keyClicks(&field(), QStringLiteral("18.65 N 226.2 E"));
    EXPECT_EQ(listed(completer()).back().toStdString(),
              "View › Go to Place… goes to coordinates (Ctrl+G).");
}

TEST_F(NameSearchTest, GoToPlaceTakesNamesAndCoordinates)
{
    openMars();
    window_->actionSet().go_to_place->trigger();
    auto* dialog = window_->findChild<GoToDialog*>();
    ASSERT_NE(dialog, nullptr);
    auto* text = dialog->findChild<QLineEdit*>(QStringLiteral("coordinate"));
    auto* answer = dialog->findChild<QLabel*>(QStringLiteral("answer"));
    text->setText(QStringLiteral("xyzzy"));
    EXPECT_EQ(answer->text().toStdString(), "No place on Mars is named “xyzzy”.");
    text->setText(QStringLiteral("18.65 N 226.2 E"));
    EXPECT_TRUE(answer->text().startsWith(QStringLiteral("18.6"))) << answer->text().toStdString();
    text->setText(QStringLiteral("elysium mons"));
    EXPECT_TRUE(answer->text().startsWith(QStringLiteral("Elysium Mons: mountain, 401 km")))
        << answer->text().toStdString();
    QTest::keyClick(text, Qt::Key_Return);
    EXPECT_TRUE(waitFor([this] { return isThere(); }));
    EXPECT_NEAR(target().latitude.degrees(), 25.02, 0.3);
}

TEST_F(NameSearchTest, ABodyWithoutNamesSaysHowToOpenAFileOfNames)
{
    makeWindow(kWide);
    const QString map = maps_.placed("earth", "EPSG:4326", {9.0, 0.02, 0.0, 47.5, 0.0, -0.02});
    ASSERT_TRUE(openAndWait(*window_, map));
    QTest::keyClicks(&field(), QStringLiteral("sa"));
    EXPECT_EQ(listed(completer()).join(u'\n').toStdString(),
              "No names on the Earth.\nOpen a file of names with File › Open Names…");

    const QString names = maps_.path(QStringLiteral("peaks.csv"));
    QFile file(names);
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write("name,lon,lat\nS\u00e4ntis,9.3433,47.2494\nMont Blanc,6.8652,45.8326\n");
    file.close();
    window_->commands().names.open(names);
    ASSERT_TRUE(waitFor([this] { return bool(window_->commands().names.namesOnMap().names); }));
    field().clear();
    QTest::keyClicks(&field(), QStringLiteral("santis"));
    EXPECT_EQ(listed(completer()), QStringList(QStringLiteral("Säntis")));
    field().clear();
    QTest::keyClicks(&field(), QStringLiteral("mont"));
    EXPECT_EQ(listed(completer()), QStringList(QStringLiteral("Mont Blanc is outside the map.")));
}

TEST_F(NameSearchTest, AFileWithoutNamesIsRefusedWithTheReason)
{
    openMars();
    QString problem;
    QObject::connect(window_.get(), &MainWindow::openFailed,
                     [&problem](const QString& text) { problem = text; });
    window_->commands().names.open(maps_.path(QStringLiteral("missing.csv")));
    EXPECT_TRUE(waitFor([&problem] { return problem.contains(QStringLiteral("does not exist")); }));
}

} // namespace
} // namespace marsview
