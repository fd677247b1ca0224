// Names that measurements and annotations get, and texts of their results, in German.

#include "tests/ui/map_window.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/panels/measure_panel.h"
#include "ui/text/language.h"
#include "ui/text/measure_text.h"
#include "ui/window/window_actions.h"

#include <QActionGroup>
#include <QLabel>
#include <QTableWidget>
#include <QTranslator>

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace marsview {
namespace {

class GermanNamesTest : public MapWindowTest {
protected:
    void SetUp() override
    {
        if (languages().size() == 1) {
            GTEST_SKIP() << "built without Qt's LinguistTools";
        }
        translators_ = translateTo(QStringLiteral("de"));
        makeWindow(kWithPanels);
        ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    }
    void TearDown() override
    {
        window_.reset(); // its texts are German until it is gone
    }

    std::vector<std::unique_ptr<QTranslator>> translators_;
};

} // namespace

TEST_F(GermanNamesTest, MeasurementsAndAnnotationsAreNamedInGerman)
{
    struct Case {
        MeasurementKind kind;
        const char* name;
    };
    MeasureController& measuring = *window_->measuring();
    for (const Case& each : {Case{MeasurementKind::Distance, "Entfernung 1"},
                             {MeasurementKind::Profile, "Profil 2"},
                             {MeasurementKind::Area, "Fläche 3"},
                             {MeasurementKind::Attitude, "Lagerung 4"},
                             {MeasurementKind::Crater, "Krater 5"},
                             {MeasurementKind::Slope, "Punkt 6"}}) {
        measuring.begin(each.kind);
        for (const GridPoint& place : {GridPoint{10.0, 10.0}, {20.0, 10.0}, {15.0, 18.0}}) {
            measuring.addPointAt(place);
            EXPECT_EQ(measuring.state().items.back().name, QString::fromUtf8(each.name));
            if (measuring.current()->isSingle()) {
                break; // the next point has a number of its own
            }
        }
        measuring.finish();
    }
    AnnotationController& annotating = *window_->annotating();
    annotating.begin(FeatureShape::Point);
    annotating.addPointAt({12.0, 12.0});
    EXPECT_EQ(annotating.state().items.back().name, QStringLiteral("Punkt 1"));
}

// German labels are long; what was measured is to the right of them.
TEST_F(GermanNamesTest, ValuesAreInViewWhereLabelsAreLong)
{
    window_->resize(1060, 640); // 1590 × 960 pixels at 150 %
    MeasureController& measuring = *window_->measuring();
    window_->actionSet().measure_kinds->actions().constFirst()->trigger(); // shows the panel
    MeasurePanel& panel = *window_->measurePanel();
    ASSERT_TRUE(waitFor([&] { return panel.isVisible(); }));
    measuring.begin(MeasurementKind::Attitude);
    for (const GridPoint& place :
         {GridPoint{10.0, 10.0}, {20.0, 10.0}, {15.0, 18.0}, {14.0, 8.0}}) {
        measuring.addPointAt(place);
    }
    measuring.finish();
    const std::uint32_t id = measuring.current()->id;
    ASSERT_TRUE(
        waitFor([&] { return measuring.outcome(id).result && !measuring.outcome(id).is_running; }));
    const auto* results = panel.findChild<QTableWidget*>(QStringLiteral("measureResults"));
    ASSERT_TRUE(waitFor([&] { return results->isVisible() && results->rowCount() > 5; }));
    QCoreApplication::processEvents();
    for (int row = 0; row < results->rowCount(); ++row) {
        const QRect cell = results->visualItemRect(results->item(row, 1));
        const QString text = results->item(row, 1)->text();
        EXPECT_LE(cell.right(), results->viewport()->width()) << qPrintable(text);
        EXPECT_GE(cell.left(), 0) << qPrintable(text);
        const QRect needed = results->fontMetrics().boundingRect(
            QRect(0, 0, cell.width(), 1000), Qt::AlignTrailing | Qt::TextWordWrap, text);
        EXPECT_LE(needed.width(), cell.width()) << qPrintable(text);
        EXPECT_LE(needed.height(), cell.height()) << qPrintable(text);
    }
}

TEST_F(GermanNamesTest, AFailureIsExplainedInGerman)
{
    MeasureController& measuring = *window_->measuring();
    measuring.begin(MeasurementKind::Attitude);
    for (const GridPoint& place : {GridPoint{10.0, 10.0}, {14.0, 10.0}, {18.0, 10.0}}) {
        measuring.addPointAt(place);
    }
    measuring.finish();
    const std::uint32_t id = measuring.current()->id;
    ASSERT_TRUE(
        waitFor([&] { return measuring.outcome(id).result && !measuring.outcome(id).is_running; }));
    ASSERT_FALSE(measuring.outcome(id).result->values);
    const auto* note = window_->measurePanel()->findChild<QLabel*>(QStringLiteral("measureNote"));
    EXPECT_TRUE(note->text().contains(QStringLiteral("Die Punkte liegen fast auf einer Linie")))
        << qPrintable(note->text());
}

TEST_F(GermanNamesTest, ResultsAreInGerman)
{
    MeasureController& measuring = *window_->measuring();
    measuring.begin(MeasurementKind::Distance);
    for (const GridPoint& place : {GridPoint{10.0, 10.0}, {20.0, 10.0}, {15.0, 18.0}}) {
        measuring.addPointAt(place);
    }
    measuring.finish();
    const std::uint32_t id = measuring.current()->id;
    ASSERT_TRUE(
        waitFor([&] { return measuring.outcome(id).result && !measuring.outcome(id).is_running; }));
    const QString text = window_->measurePanel()->resultsText();
    EXPECT_TRUE(text.startsWith(QStringLiteral("Entfernung 1\nGeodätische Entfernung\t")))
        << qPrintable(text);
    EXPECT_TRUE(text.contains(QStringLiteral("\nAbschnitt 2\t"))) << qPrintable(text);
    EXPECT_EQ(measurementName(MeasurementKind::Slope), QStringLiteral("Höhe und Neigung"));
}

} // namespace marsview
