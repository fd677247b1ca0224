// The form for body, CRS and more, operated by mouse and keyboard in a window.

#include "tests/ui/color_contrast.h"
#include "tests/ui/map_window.h"
#include "ui/panels/crs_field.h"
#include "ui/panels/georeferencing_panel.h"
#include "ui/panels/override_form.h"
#include "ui/widgets/form_field.h"
#include "ui/widgets/notice_bar.h"
#include "ui/window/theme.h"
#include "ui/window/window_actions.h"

#include <QAbstractItemView>
#include <QApplication>
#include <QComboBox>
#include <QLabel>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>

#include <gtest/gtest.h>

namespace marsview {
namespace {

class OverrideFormTest : public MapWindowTest {
protected:
    void SetUp() override
    {
        WindowOptions options = testWindowOptions();
        options.failures = WindowOptions::Failures::AsNotices;
        makeWindow({1280, 900}, options);
        ASSERT_TRUE(waitUntilSettled(*window_));
    }

    OverrideForm& form() { return *window_->findChild<OverrideForm*>(); }
    template <typename Widget = QLineEdit>
    Widget* field(const char* name)
    {
        return form().findChild<Widget*>(QLatin1String(name));
    }
    QString noteOf(const char* name)
    {
        auto* note = form().findChild<QLabel*>(QLatin1String(name) + QStringLiteral("Note"));
        return note->isVisible() ? note->text() : QString();
    }
    void openForm() { window_->actionSet().override_georeferencing->trigger(); }
    void apply() { QTest::mouseClick(field<QPushButton>("apply"), Qt::LeftButton); }
    void expectRefused(const char* name, const QString& entered)
    {
        EXPECT_EQ(window_->findChild<QMessageBox*>(), nullptr);
        EXPECT_TRUE(form().isVisible());
        EXPECT_FALSE(field<QWidget>(name)->accessibleDescription().isEmpty());
        EXPECT_EQ(noteOf(name), field<QWidget>(name)->accessibleDescription());
        EXPECT_TRUE(field<QWidget>(name)->hasFocus());
        EXPECT_EQ(field(name)->text(), entered);
        EXPECT_TRUE(window_->view()->map()->spec().overrides.isEmpty());
    }
    const RasterInfo& info() { return activeLayer(window_->session())->map->info(); }
};

TEST_F(OverrideFormTest, ItsButtonsStayInSightWhateverIsScrolled)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    window_->resize(kWithPanels);
    openForm();
    for (const char* last : {"crs", "nodata", "term5"}) {
        field<QWidget>(last)->setFocus();
        EXPECT_TRUE(waitFor([&] { return !field<QWidget>(last)->visibleRegion().isEmpty(); }))
            << last;
        for (const char* name : {"apply", "close", "reset"}) {
            const auto* button = field<QPushButton>(name);
            EXPECT_EQ(button->visibleRegion().boundingRect(), button->rect())
                << name << " with the focus on " << last;
        }
    }
}

TEST_F(OverrideFormTest, WritesAndReadsTrueMinusSigns)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    openForm();
    // 0.25 degrees per row, from north to south.
    EXPECT_EQ(field("term5")->placeholderText(), QStringLiteral("−0.25"));
    for (const char* entered : {"-1737.4", "−1737.4"}) {
        field("offset")->setText(QString::fromUtf8(entered));
        apply();
        ASSERT_TRUE(waitFor([&] { return info().offset == -1737.4; })) << entered;
        openForm();
        EXPECT_EQ(field("offset")->text(), QStringLiteral("−1737.4"));
        QTest::mouseClick(field<QPushButton>("reset"), Qt::LeftButton);
        ASSERT_TRUE(waitFor([&] { return info().offset == 0.0; }));
        openForm();
    }
}

TEST_F(OverrideFormTest, ReportsAnUnknownCrsBelowItsField)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    openForm();
    EXPECT_TRUE(field("crs")->hasFocus());
    const QSignalSpy failures(window_.get(), &MainWindow::openFailed);
    QTest::keyClicks(field("crs"), QStringLiteral("EPSG:nonsense"));
    QTest::keyClick(field("crs"), Qt::Key_Return);
    expectRefused("crs", QStringLiteral("EPSG:nonsense"));
    EXPECT_TRUE(noteOf("crs").contains(QStringLiteral("EPSG:nonsense")));
    EXPECT_EQ(failures.count(), 0);
    // Once corrected, it is accepted.
    field("crs")->selectAll();
    QTest::keyClicks(field("crs"), QStringLiteral("EPSG:32611"));
    apply();
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_EQ(info().body, bodyNamed("Earth"));
    EXPECT_FALSE(form().isVisible());
}

TEST_F(OverrideFormTest, RefusesDegreesOnAGridInMetersAndTheReverse)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill())); // x from 500 000
    openForm();
    field("crs")->setText(QStringLiteral("EPSG:4326"));
    apply();
    expectRefused("crs", QStringLiteral("EPSG:4326"));

    ASSERT_TRUE(openAndWait(
        *window_,
        maps_.write(
            QStringLiteral("globe.asc"),
            {.columns = 72, .rows = 36, .x_lower_left = 0.0, .y_lower_left = -90.0, .cell = 5.0},
            [](int column, int row) { return 10.0 * column + row; })));
    openForm();
    field("crs")->setText(QStringLiteral("EPSG:32611"));
    apply();
    expectRefused("crs", QStringLiteral("EPSG:32611"));
}

TEST_F(OverrideFormTest, ChecksNumbersWhileTheyAreTyped)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    openForm();
    field("scale")->setFocus();
    QTest::keyClicks(field("scale"), QStringLiteral("two"));
    EXPECT_TRUE(QTest::qWaitFor([this] { return !noteOf("scale").isEmpty(); }, kTimeout));
    EXPECT_TRUE(noteOf("scale").contains(QStringLiteral("two")));
    field("scale")->selectAll();
    QTest::keyClicks(field("scale"), QStringLiteral("2"));
    EXPECT_EQ(noteOf("scale"), QString());
    // If several fields are invalid, the first one gets the focus.
    field("equatorial")->setText(QStringLiteral("wide"));
    field("nodata")->setText(QStringLiteral("none"));
    apply();
    EXPECT_TRUE(field("equatorial")->hasFocus());
    EXPECT_FALSE(noteOf("nodata").isEmpty());
    EXPECT_TRUE(form().isVisible());
}

TEST_F(OverrideFormTest, ReportsWhatTheFileCannotTakeBelowItsField)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    openForm();
    field("scale")->setText(QStringLiteral("0"));
    apply();
    expectRefused("scale", QStringLiteral("0"));
    field("scale")->clear();
    field("term1")->setText(QStringLiteral("0"));
    apply();
    EXPECT_FALSE(noteOf("transform").isEmpty());
    EXPECT_TRUE(form().isVisible());
    field("term1")->clear();
    field("equatorial")->setText(QStringLiteral("1000"));
    field("polar")->setText(QStringLiteral("2000"));
    apply();
    EXPECT_FALSE(noteOf("equatorial").isEmpty());
    EXPECT_TRUE(field("equatorial")->hasFocus());
}

// Detected only when the file is read again.
TEST_F(OverrideFormTest, ReportsANodataValueThatLeavesNothingBelowItsField)
{
    ASSERT_TRUE(openAndWait(
        *window_, maps_.write(QStringLiteral("flat.asc"), {}, [](int, int) { return 7.0; })));
    openForm();
    field("nodata")->setText(QStringLiteral("7"));
    apply();
    ASSERT_TRUE(QTest::qWaitFor([this] { return !noteOf("nodata").isEmpty(); }, kTimeout));
    expectRefused("nodata", QStringLiteral("7"));
}

TEST_F(OverrideFormTest, SetsScaleOffsetAndVerticalDatum)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    const auto sample = [this] {
        return activeLayer(window_->session())->map->heightfield().height({12.0, 7.0});
    };
    const double before = sample();
    openForm();
    field("scale")->setText(QStringLiteral("2.5"));
    field("offset")->setText(QStringLiteral("−10")); // as users type it
    field("datum")->setText(QStringLiteral("EGM2008"));
    apply();
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_NEAR(sample(), 2.5 * before - 10.0, 1e-9);
    EXPECT_EQ(info().vertical_datum, "EGM2008");
    window_->undoStack().undo();
    EXPECT_NEAR(sample(), before, 1e-12);
}

TEST_F(OverrideFormTest, FindsACrsByNameWithTheKeyboard)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    openForm();
    auto* crs = field<CrsField>("crs");
    ASSERT_TRUE(QTest::qWaitFor([crs] { return crs->isLoaded(); }, kTimeout));
    QTest::keyClicks(crs, QStringLiteral("utm 11N wgs84"));
    QAbstractItemView* list = crs->matchList();
    ASSERT_TRUE(QTest::qWaitFor([list] { return list->isVisible(); }, kTimeout));
    EXPECT_EQ(crs->matches().front(), QStringLiteral("EPSG:32611"));
    EXPECT_TRUE(crs->matches().size() > 1);
    const QString second = crs->matches().at(1);
    QTest::keyClick(list, Qt::Key_Down);
    QTest::keyClick(list, Qt::Key_Return);
    EXPECT_EQ(crs->text(), second);
    EXPECT_TRUE(form().isVisible()); // choosing applies nothing yet
    EXPECT_TRUE(window_->view()->map()->spec().overrides.isEmpty());
    EXPECT_FALSE(noteOf("crs").isEmpty()); // its name, in words
}

TEST_F(OverrideFormTest, TheHintIsThatOfTheEnteredCrs)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    openForm();
    const QString of_nothing = noteOf("crs");
    EXPECT_FALSE(of_nothing.isEmpty());
    const auto enter = [this](const QString& text) {
        field("crs")->selectAll();
        QTest::keyClicks(field("crs"), text);
    };
    enter(QStringLiteral("+proj=utm +zone=33"));
    EXPECT_TRUE(waitFor([&] { return noteOf("crs").contains(QStringLiteral("on the Earth")); }));
    field("crs")->selectAll();
    QTest::keyClick(field("crs"), Qt::Key_Delete);
    EXPECT_TRUE(waitFor([&] { return noteOf("crs") == of_nothing; }))
        << noteOf("crs").toStdString();
    enter(QStringLiteral("+proj=utm +zone=33"));
    EXPECT_TRUE(waitFor([&] { return noteOf("crs").contains(QStringLiteral("on the Earth")); }));
    QTest::keyClick(field("crs"), Qt::Key_Backspace);
    QTest::keyClick(field("crs"), Qt::Key_Backspace);
    QTest::keyClick(field("crs"), Qt::Key_Backspace);
    EXPECT_TRUE(waitFor([&] { return !noteOf("crs").contains(QStringLiteral("on the Earth")); }));
}

TEST_F(OverrideFormTest, FindsACrsByNameWithTheMouse)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    openForm();
    auto* crs = field<CrsField>("crs");
    ASSERT_TRUE(QTest::qWaitFor([crs] { return crs->isLoaded(); }, kTimeout));
    QTest::keyClicks(crs, QStringLiteral("32611"));
    QAbstractItemView* list = crs->matchList();
    ASSERT_TRUE(QTest::qWaitFor([list] { return list->isVisible(); }, kTimeout));
    const QModelIndex first = list->model()->index(0, 0);
    EXPECT_TRUE(first.data().toString().contains(QStringLiteral("WGS 84 / UTM zone 11N")));
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualRect(first).center());
    EXPECT_EQ(crs->text(), QStringLiteral("EPSG:32611"));
    apply();
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_EQ(info().body, bodyNamed("Earth"));
}

TEST_F(OverrideFormTest, OffersSystemsForAGridThatLooksLikeDegrees)
{
    ASSERT_TRUE(openAndWait(
        *window_,
        maps_.write(
            QStringLiteral("globe.asc"),
            {.columns = 72, .rows = 36, .x_lower_left = 0.0, .y_lower_left = -90.0, .cell = 5.0},
            [](int column, int row) { return 10.0 * column + row; })));
    EXPECT_EQ(info().body, nullptr);
    auto* bar = window_->findChild<NoticeBar*>();
    auto* button = bar->findChild<QToolButton*>(QStringLiteral("noticeAction"));
    ASSERT_TRUE(button->isVisible());
    ASSERT_NE(button->menu(), nullptr);
    QAction* mars = nullptr;
    for (QAction* action : button->menu()->actions()) {
        if (action->text().contains(QStringLiteral("Mars"))) {
            mars = action;
        }
    }
    ASSERT_NE(mars, nullptr);
    EXPECT_TRUE(button->menu()->actions().front()->text().contains(QStringLiteral("WGS 84")));
    const int steps = window_->undoStack().count();
    mars->trigger();
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_EQ(info().body, bodyNamed("Mars"));
    ASSERT_TRUE(info().crs);
    EXPECT_EQ(info().crs->kind(), CrsKind::Geographic);
    EXPECT_EQ(window_->undoStack().count(), steps + 1);
    window_->undoStack().undo();
    EXPECT_EQ(info().body, nullptr);
}

TEST(FormField, ShowsProblemsInAReadableRed)
{
    for (const QPalette& palette : {lightPalette(), darkPalette()}) {
        EXPECT_GE(contrast(problemColor(palette), palette.color(QPalette::Window)), 4.5);
    }
}

TEST_F(OverrideFormTest, CancelForgetsWhatWasEntered)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    openForm();
    field("crs")->setText(QStringLiteral("rubbish"));
    apply();
    EXPECT_FALSE(noteOf("crs").isEmpty());
    QTest::mouseClick(field<QPushButton>("close"), Qt::LeftButton);
    EXPECT_FALSE(form().isVisible());
    openForm();
    EXPECT_EQ(field("crs")->text(), QString());
    EXPECT_TRUE(field("crs")->accessibleDescription().isEmpty());
}

} // namespace
} // namespace marsview
