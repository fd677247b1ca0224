// Reports of a map and its measurements, as web page and PDF.
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"
#include "tests/ui/map_window.h"
#include "tests/ui/project_files.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/project/project_controller.h"
#include "ui/render/supersampled_picture.h"
#include "ui/report/report_exporter.h"
#include "ui/report/report_pdf.h"
#include "ui/text/coordinate_text.h"
#include "ui/text/measure_text.h"

#include <QAction>
#include <QCheckBox>
#include <QDialog>
#include <QFile>
#include <QFileDialog>
#include <QImage>
#include <QLineEdit>
#include <QLocale>
#include <QPushButton>
#include <QRegularExpression>
#include <QSignalSpy>
#include <QTest>
#include <QXmlStreamReader>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace marsview {
namespace {

class ReportTest : public MapWindowTest {
protected:
    void openMars()
    {
        makeWindow(kWithPanels);
        ASSERT_TRUE(openAndWait(*window_, QString::fromStdString(test::bundledMars())));
    }
    void measure(MeasurementKind kind, const std::vector<GridPoint>& points)
    {
        MeasureController& measure = *window_->measuring();
        measure.begin(kind);
        for (const GridPoint& point : points) {
            measure.addPointAt(point);
        }
        measure.finish();
        const std::uint32_t id = measure.state().items.back().id;
        ASSERT_TRUE(
            waitFor([&] { return measure.outcome(id).result && !measure.outcome(id).is_running; }));
    }
    void measureSome()
    {
        measure(MeasurementKind::Profile, {{300.0, 300.0}, {420.0, 340.0}});
        measure(MeasurementKind::Area, {{300.0, 300.0}, {340.0, 300.0}, {320.0, 340.0}});
        measure(MeasurementKind::Attitude,
                {{300.0, 300.0}, {340.0, 300.0}, {320.0, 340.0}, {310.0, 330.0}});
    }
    QString path(const char* name) const { return QString::fromStdString(folder_.file(name)); }
    QByteArray exported(const char* name, const ReportChoice& choice)
    {
        QSignalSpy saved(&window_->commands().reports, &ReportExporter::saved);
        QSignalSpy failed(&window_->commands().reports, &ReportExporter::failed);
        window_->commands().reports.exportTo(path(name), choice);
        EXPECT_TRUE(waitFor([&] { return saved.count() + failed.count() == 1; }));
        EXPECT_EQ(failed.count(), 0);
        QFile file(path(name));
        EXPECT_TRUE(file.open(QIODevice::ReadOnly));
        return file.readAll();
    }

    test::TempFolder folder_;
};

// Width in units of the strip, and text of the scale bar.
struct DrawnBar {
    double width = 0.0;
    QString text;
};

DrawnBar barIn(const QByteArray& svg)
{
    DrawnBar bar;
    QXmlStreamReader reader(svg);
    QString last_text;
    while (!reader.atEnd()) {
        reader.readNext();
        if (reader.isStartElement() && reader.name() == QLatin1String("line") &&
            reader.attributes().value(QLatin1String("stroke-width")) == QLatin1String("2")) {
            const double width = reader.attributes().value(QLatin1String("x2")).toDouble() -
                                 reader.attributes().value(QLatin1String("x1")).toDouble();
            if (width > bar.width) {
                bar.width = width;
                bar.text = last_text;
            }
        }
        if (reader.isCharacters() && !reader.isWhitespace()) {
            last_text = reader.text().toString();
        }
    }
    EXPECT_FALSE(reader.hasError()) << reader.errorString().toStdString();
    return bar;
}

} // namespace

TEST_F(ReportTest, TheWebPageHoldsEverythingAndNeedsNoOtherFile)
{
    openMars();
    measureSome();
    window_->measuring()->setNote(window_->measuring()->state().items[0].id,
                                  QStringLiteral("a < b & c"));
    const QString page =
        QString::fromUtf8(exported("report.html", {.title = QStringLiteral("<Tharsis> & more"),
                                                   .credit = QStringLiteral("MOLA team")}));
    EXPECT_TRUE(page.contains(QStringLiteral("<h1>&lt;Tharsis&gt; &amp; more</h1>")));
    EXPECT_TRUE(page.contains(QStringLiteral("MOLA team")));
    EXPECT_TRUE(page.contains(QStringLiteral("a &lt; b &amp; c")));
    EXPECT_TRUE(page.contains(QStringLiteral("Mars")));
    EXPECT_TRUE(
        page.contains(QString::fromStdString(view().map()->info().crs->name()).toHtmlEscaped()));
    // Every result that the panel shows is there.
    for (const MeasureItem& item : window_->measuring()->state().items) {
        const MeasureOutcome& outcome = window_->measuring()->outcome(item.id);
        for (const MeasureRow& row : measureRows(*outcome.result, HeightUnit::Meters)) {
            EXPECT_TRUE(page.contains(row.value.toHtmlEscaped())) << row.value.toStdString();
        }
    }
    // The points of the profile with their positions, as the format has them.
    const auto place = view().map()->georeference().toGeographic({420.0, 340.0});
    EXPECT_TRUE(
        page.contains(QStringLiteral("%1° ").arg(std::abs(place->latitude.degrees()), 0, 'f', 2)))
        << place->latitude.degrees();
    EXPECT_TRUE(page.contains(QStringLiteral("Position")));
    // Of a diagram of 1200 × 500 with room for labels: elevations fill its height, distances its
    // width.
    const Profile& profile =
        *window_->measuring()->outcome(window_->measuring()->state().items[0].id).as<Profile>();
    const auto [lowest, highest] = std::minmax_element(
        profile.points.begin(), profile.points.end(),
        [](const ProfilePoint& a, const ProfilePoint& b) { return a.elevation_m < b.elevation_m; });
    const double across_per_up =
        profile.points.back().distance_m / (highest->elevation_m - lowest->elevation_m);
    const QRegularExpression caption(QStringLiteral("Vertical exaggeration ([0-9.,]+)<"));
    const double stated = QLocale().toDouble(caption.match(page).captured(1));
    EXPECT_GT(stated, 300.0 / 1200.0 / 1.12 * across_per_up);
    EXPECT_LT(stated, 500.0 / 1000.0 * across_per_up);
    EXPECT_EQ(page.count(QLocale().toString(14817.8, 'f', 1)), 2);
    // Nothing is loaded from elsewhere: all addresses are data.
    const QRegularExpression address(QStringLiteral("(?:src|href)=\"([^\"]{0,12})"));
    int images = 0;
    for (auto it = address.globalMatch(page); it.hasNext();) {
        EXPECT_TRUE(it.next().captured(1).startsWith(QLatin1String("data:image/")));
        ++images;
    }
    EXPECT_EQ(images, 4) << "the map, the profile, the hypsometry, the stereonet";
    // 2026-11: labels were 4 pixels high. A drawing is 720 pixels wide, a square one 420.
    const QRegularExpression drawn(
        QStringLiteral("class=\"(drawing|square)\"><img[^>]*data:image/svg.xml;base64,([^\"]+)\""));
    const QRegularExpression view_box(QStringLiteral("viewBox=\"0 0 (\\d+) "));
    const QRegularExpression size(QStringLiteral("font-size=\"(\\d+)\"[^>]*>\\s*<text"));
    int labels = 0;
    int whole = 0;
    for (auto it = drawn.globalMatch(page); it.hasNext();) {
        const QRegularExpressionMatch figure = it.next();
        const QString svg =
            QString::fromUtf8(QByteArray::fromBase64(figure.captured(2).toLatin1()));
        whole += svg.contains(withUnit(QStringLiteral("100"), QStringLiteral("%"))) ? 1 : 0;
        const double pixels = (figure.captured(1) == QStringLiteral("square") ? 420.0 : 720.0) /
                              view_box.match(svg).captured(1).toDouble();
        for (auto label = size.globalMatch(svg); label.hasNext(); ++labels) {
            EXPECT_GE(label.next().captured(1).toDouble() * pixels, 11.0);
        }
    }
    EXPECT_GT(labels, 20);
    EXPECT_EQ(whole, 1) << "the last number of the axis of shares is drawn";
    EXPECT_LT(page.indexOf(QStringLiteral("class=\"drawing\"")),
              page.indexOf(QStringLiteral(">Point</th>")))
        << "a diagram is below the results, not below all points";
    EXPECT_FALSE(page.contains(QStringLiteral("<script")));
    const QRegularExpression picture(QStringLiteral("data:image/jpeg;base64,([^\"]+)\""));
    const QImage map = QImage::fromData(
        QByteArray::fromBase64(picture.match(page).captured(1).toLatin1()), "JPEG");
    EXPECT_EQ(map.size(), QSize(2000, 1500));
}

// 2026-11: pictures of steep terrain were drawn a second time, at nine times the samples.
TEST_F(ReportTest, PicturesOfHighContrastAreDrawnOnce)
{
    openMars();
    view().setExaggeration(100.0);
    std::vector<double> shares;
    QObject::connect(&window_->commands().reports, &ReportExporter::progressed, window_.get(),
                     [&shares](const QString&, double share) { shares.push_back(share); });
    const QString page = QString::fromUtf8(exported("steep.html", {.title = QStringLiteral("x")}));
    const QRegularExpression picture(QStringLiteral("data:image/jpeg;base64,([^\"]+)\""));
    const QImage map =
        QImage::fromData(QByteArray::fromBase64(picture.match(page).captured(1).toLatin1()), "JPEG")
            .convertToFormat(QImage::Format_RGB888);
    ASSERT_EQ(map.size(), QSize(2000, 1500));
    EXPECT_GT(contrastOf({.first = map.constBits(),
                          .width = map.width(),
                          .height = map.height(),
                          .line_length = map.bytesPerLine()},
                         view().style()),
              kSmoothContrastMax);
    EXPECT_LE(shares.size(), 1U + 4U * 3U) << "blocks of 512 × 512 pixels";
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_EQ(shares.back(), 1.0);
}

TEST_F(ReportTest, ATickPutsAnnotationsWithPositionAndNoteIntoATable)
{
    openMars();
    AnnotationController& annotating = *window_->annotating();
    annotating.begin(FeatureShape::Point);
    annotating.addPointAt({300.0, 300.0});
    annotating.rename(1, QStringLiteral("Dark <streak>"));
    annotating.setNote(1, QStringLiteral("a slope & a fan"));
    annotating.begin(FeatureShape::Line);
    annotating.addPointAt({320.0, 300.0});
    annotating.addPointAt({340.0, 320.0});
    annotating.finish();
    const auto place = view().map()->georeference().toGeographic({300.0, 300.0});
    const QString position =
        positionText({}, *view().map(), GridPoint{300.0, 300.0}).toHtmlEscaped();
    ASSERT_TRUE(position.startsWith(QString::number(std::abs(place->latitude.degrees()), 'f', 2)))
        << qPrintable(position);
    const QString with = QString::fromUtf8(exported("with.html", {.title = QStringLiteral("x")}));
    for (const QString& text :
         {QStringLiteral("Dark &lt;streak&gt;"), QStringLiteral("a slope &amp; a fan"), position,
          QStringLiteral("Line 2"), QStringLiteral("from ")}) {
        EXPECT_TRUE(with.contains(text)) << qPrintable(text);
    }
    const QString without = QString::fromUtf8(
        exported("without.html", {.title = QStringLiteral("x"), .has_annotations = false}));
    EXPECT_FALSE(without.contains(QStringLiteral("a slope &amp; a fan")));
}

TEST_F(ReportTest, TheTableHasDepthAndDepthToDiameterOfCraters)
{
    openMars();
    measure(MeasurementKind::Crater,
            {{300.0, 300.0}, {340.0, 300.0}, {320.0, 320.0}, {320.0, 280.0}});
    const MeasureOutcome& outcome = window_->measuring()->outcome(1);
    const auto* crater = outcome.as<Crater>();
    ASSERT_NE(crater, nullptr);
    const QString page = QString::fromUtf8(exported("report.html", {.title = QStringLiteral("x")}));
    const QRegularExpression row(
        QStringLiteral("⌀ ([\\d,.]+) km, depth (−?[\\d,]+) m, d/D "
                       "(−?0\\.\\d+)"));
    const auto found = row.match(page);
    ASSERT_TRUE(found.hasMatch());
    const auto number = [&](int group) {
        return found.captured(group)
            .remove(QLatin1Char(','))
            .replace(QChar(0x2212), QLatin1Char('-'))
            .toDouble();
    };
    EXPECT_NEAR(number(1), crater->diameter_m / 1000.0, 0.01 * crater->diameter_m / 1000.0);
    EXPECT_NEAR(number(2), crater->depth_m, 5.1) << "the samples are 14.8 km apart";
    EXPECT_NEAR(number(3), crater->depth_m / crater->diameter_m, 0.0051);
}

TEST_F(ReportTest, TheScaleBarIsAsLongAsItSays)
{
    openMars();
    for (const double factor : {1.0, 0.3, 0.05}) {
        OrbitCamera camera = view().camera();
        camera.distance_m *= factor;
        view().setCamera(camera);
        const QSize size(2000, 1500);
        const Report report = reportOf({.map = window_->commands().reports.scene().facts(size),
                                        .session = window_->session(),
                                        .measuring = *window_->measuring(),
                                        .annotating = *window_->annotating()},
                                       {.title = QStringLiteral("x")}, size);
        const DrawnBar bar = barIn(mapKeySvg(report.map));
        const double width_m =
            size.width() * metersPerPixel(view().camera(), {size.width(), size.height()});
        QString number = bar.text;
        number.remove(QLatin1Char(',')).remove(QStringLiteral(" km"));
        EXPECT_NEAR(bar.width / 1000.0 * width_m / (1000.0 * number.toDouble()), 1.0, 1e-3)
            << bar.text.toStdString();
    }
}

TEST_F(ReportTest, NorthIsWhereTheCameraTurnedIt)
{
    openMars();
    OrbitCamera camera = view().camera();
    camera.azimuth = Angle::degrees(30.0);
    view().setCamera(camera);
    const Report report = reportOf({.map = window_->commands().reports.scene().facts({800, 600}),
                                    .session = window_->session(),
                                    .measuring = *window_->measuring(),
                                    .annotating = *window_->annotating()},
                                   {.title = QStringLiteral("x")}, {800, 600});
    EXPECT_NEAR(report.map.north_deg, -30.0, 1e-3);
}

// 2026-11: they were in the panel alone.
TEST_F(ReportTest, StatisticsOfAttitudesAreNextToTheStereonet)
{
    openMars();
    measure(MeasurementKind::Attitude, {{500.0, 300.0}, {512.0, 302.0}, {505.0, 312.0}});
    const QString one = QString::fromUtf8(exported("one.html", {.title = QStringLiteral("x")}));
    EXPECT_FALSE(one.contains(QStringLiteral("Mean plane")));
    EXPECT_FALSE(one.contains(QStringLiteral("dotted: the mean plane")));
    measure(MeasurementKind::Attitude, {{540.0, 300.0}, {552.0, 302.0}, {545.0, 312.0}});
    const QString two = QString::fromUtf8(exported("two.html", {.title = QStringLiteral("x")}));
    EXPECT_TRUE(two.contains(QStringLiteral("dotted: the mean plane")));
    EXPECT_TRUE(two.contains(QRegularExpression(
        QStringLiteral("Attitudes: 2 · Mean plane: strike \\d+°, dip \\d+° · Mean pole: trend"))));
}

TEST_F(ReportTest, UnitsAreThoseOfThePreferences)
{
    openMars();
    measure(MeasurementKind::Profile, {{300.0, 300.0}, {420.0, 340.0}});
    Preferences preferences = window_->preferences();
    preferences.height_unit = HeightUnit::Feet;
    window_->setPreferences(preferences);
    const QString page = QString::fromUtf8(exported("report.html", {.title = QStringLiteral("x")}));
    const MeasureOutcome& outcome =
        window_->measuring()->outcome(window_->measuring()->state().items[0].id);
    for (const MeasureRow& row : measureRows(*outcome.result, HeightUnit::Feet)) {
        EXPECT_TRUE(page.contains(row.value.toHtmlEscaped())) << row.value.toStdString();
    }
    EXPECT_TRUE(page.contains(QStringLiteral("Elevation (ft)")));
}

// 2026-11: they ended at the edge of their column.
TEST_F(ReportTest, LongNamesWrapInThePdf)
{
    const auto pagesWith = [this](const QString& name) {
        Report report{.title = QStringLiteral("names"), .sections = {}};
        report.map.picture = QImage(80, 20, QImage::Format_RGB32);
        ReportSection section{.title = QStringLiteral("Layers")};
        section.table = ReportTable{.header = {QStringLiteral("Layer"), QStringLiteral("Pixel")},
                                    .rows = {{name, QStringLiteral("1 m")}}};
        report.sections.append(section);
        EXPECT_TRUE(writeReportPdf(report, path("names.pdf"), QPageSize::A4));
        QFile file(path("names.pdf"));
        EXPECT_TRUE(file.open(QIODevice::ReadOnly));
        const QRegularExpression count(QStringLiteral("/Count (\\d+)"));
        return count.match(QString::fromLatin1(file.readAll())).captured(1).toInt();
    };
    EXPECT_EQ(pagesWith(QStringLiteral("mars_mola.tif")), 1);
    EXPECT_EQ(pagesWith(QString(2400, QLatin1Char('m'))), 2);
}

TEST_F(ReportTest, LongTablesContinueOnFurtherPagesOfThePdf)
{
    openMars();
    Report report{.title = QStringLiteral("Long"), .subtitle = QStringLiteral("Mars")};
    report.map.picture = QImage(400, 300, QImage::Format_RGB32);
    report.map.picture.fill(Qt::darkGray);
    ReportSection section{.title = QStringLiteral("Table")};
    section.table = ReportTable{.header = {QStringLiteral("Name"), QStringLiteral("Value")}};
    for (int i = 0; i < 120; ++i) {
        section.table->rows.append({QStringLiteral("row %1").arg(i), QString::number(i)});
    }
    report.sections.append(section);
    ASSERT_TRUE(writeReportPdf(report, path("long.pdf"), QPageSize::A4));
    QFile file(path("long.pdf"));
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    const QByteArray pdf = file.readAll();
    EXPECT_TRUE(pdf.startsWith("%PDF"));
    const QRegularExpression count(QStringLiteral("/Count (\\d+)"));
    EXPECT_GE(count.match(QString::fromLatin1(pdf)).captured(1).toInt(), 3);
    EXPECT_FALSE(writeReportPdf(report, path("no/such/folder.pdf"), QPageSize::A4));
}

// 2026-11: single rows of tables were alone on a page, and headings at the foot of one.
TEST_F(ReportTest, PagesOfThePdfKeepHeadingsWithRowsAndRowsTogether)
{
    const auto is_row = [](const QString& text) { return text.startsWith(QLatin1String("row ")); };
    for (int lines = 1; lines < 60; ++lines) { // of the first table: they move the other ones
        Report report{.title = QStringLiteral("Breaks")};
        report.map.picture = QImage(400, 100, QImage::Format_RGB32);
        const auto add_section = [&report](const QString& title, int rows, bool has_note) {
            ReportSection section{.title = QStringLiteral("heading ") + title};
            section.note = has_note ? QStringLiteral("note") : QString();
            section.table = ReportTable{.header = {QStringLiteral("head")}};
            for (int i = 0; i < rows; ++i) {
                section.table->rows.append({QStringLiteral("row %1 %2").arg(title).arg(i)});
            }
            report.sections.append(section);
        };
        add_section(QStringLiteral("first"), lines, false);
        for (int rows = 1; rows <= 7; ++rows) {
            add_section(QString::number(rows), rows, rows % 2 == 0);
        }
        const std::vector<QStringList> pages = reportPages(report, QPageSize::A4);
        ASSERT_GE(pages.size(), 2U);
        for (const QStringList& page : pages) {
            EXPECT_TRUE(is_row(page.constLast())) << lines << ": " << qPrintable(page.constLast());
            for (const ReportSection& section : report.sections) {
                qsizetype here = 0;
                for (const QStringList& row : section.table->rows) {
                    here += page.count(row.constFirst());
                }
                EXPECT_TRUE(here != 1 || section.table->rows.size() == 1)
                    << lines << ": " << qPrintable(section.title);
                EXPECT_TRUE(!page.contains(section.title) || here > 0)
                    << lines << ": " << qPrintable(section.title);
            }
        }
    }
}

TEST_F(ReportTest, TheDialogAsksForTitleAndContentsByKeyboard)
{
    makeWindow(kWithPanels);
    EXPECT_FALSE(window_->commands().reports.action()->isEnabled());
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    window_->commands().reports.action()->trigger();
    QDialog* dialog = window_->commands().reports.dialog();
    ASSERT_NE(dialog, nullptr);
    auto* title = dialog->findChild<QLineEdit*>(QStringLiteral("title"));
    EXPECT_EQ(title->text(), QStringLiteral("mars"));
    EXPECT_FALSE(dialog->findChild<QCheckBox*>(QStringLiteral("measurements"))->isEnabled());
    EXPECT_FALSE(dialog->findChild<QCheckBox*>(QStringLiteral("annotations"))->isEnabled());
    title->selectAll();
    QTest::keyClicks(title, QStringLiteral("Gale"));
    QTest::keyClick(title, Qt::Key_Return);
    auto* files = window_->findChild<QFileDialog*>(QStringLiteral("reportFileDialog"));
    ASSERT_NE(files, nullptr);
    QSignalSpy saved(&window_->commands().reports, &ReportExporter::saved);
    Q_EMIT files->fileSelected(path("gale.pdf"));
    files->close();
    ASSERT_TRUE(waitFor([&] { return saved.count() == 1; }));
    QFile file(path("gale.pdf"));
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    // Texts of a PDF's description are in UTF-16, the higher byte first.
    EXPECT_TRUE(file.readAll().contains(QByteArray("\0G\0a\0l\0e", 8)));
}

TEST_F(ReportTest, TheTitleIsThatOfTheProjectUntilAnotherIsTyped)
{
    makeWindow(kWithPanels);
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    window_->annotating()->begin(FeatureShape::Point);
    window_->annotating()->addPointAt({10.0, 10.0});
    ASSERT_TRUE(saveProject(window_->commands().project, path("Gale crater.mvproj")));
    ASSERT_TRUE(waitFor([this] { return !window_->commands().project.isWriting(); }));
    window_->commands().reports.action()->trigger();
    QDialog* dialog = window_->commands().reports.dialog();
    ASSERT_NE(dialog, nullptr);
    EXPECT_EQ(dialog->findChild<QLineEdit*>(QStringLiteral("title"))->text(),
              QStringLiteral("Gale crater"));
    auto* annotations = dialog->findChild<QCheckBox*>(QStringLiteral("annotations"));
    EXPECT_TRUE(annotations->isEnabled());
    EXPECT_TRUE(annotations->isChecked());
    dialog->reject();
}

TEST_F(ReportTest, CancelingWritesNothing)
{
    openMars();
    QSignalSpy canceled(&window_->commands().reports, &ReportExporter::canceled);
    window_->commands().reports.exportTo(path("report.html"), {.title = QStringLiteral("x")});
    ASSERT_TRUE(window_->commands().reports.isExporting());
    window_->commands().reports.cancel();
    EXPECT_EQ(canceled.count(), 1);
    EXPECT_FALSE(window_->commands().reports.isExporting());
    QCoreApplication::processEvents();
    EXPECT_FALSE(QFile::exists(path("report.html")));
}

} // namespace marsview
