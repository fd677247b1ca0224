#include "ui/report/report_contents.h"

#include "core/view/scale_bar.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/plots/hypsometry_plot.h"
#include "ui/plots/profile_plot.h"
#include "ui/plots/stereonet_plot.h"
#include "ui/text/annotation_text.h"
#include "ui/text/attitude_text.h"
#include "ui/text/body_text.h"
#include "ui/text/coordinate_text.h"
#include "ui/text/measure_text.h"
#include "ui/text/overlay_text.h"
#include "ui/text/sentence.h"

#include <QCoreApplication>
#include <QDateTime>
#include <QFile>
#include <QFileInfo>
#include <QFont>
#include <QGuiApplication>
#include <QLocale>
#include <QSvgRenderer>
#include <QTemporaryDir>

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

constexpr int kLegendTicksMost = 7;
constexpr int kLegendColors = 33;
constexpr double kScaleShareMax = 0.38; // of the picture's width

QString reportTr(const char* text)
{
    return QCoreApplication::translate("Report", text);
}

// A drawing that is written as a file of its own.
template <typename Plot>
std::optional<ReportFigure> figureOf(Plot& plot, const QString& caption)
{
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("figure.svg"));
    if (!folder.isValid() || !plot.savePicture(path)) {
        return std::nullopt;
    }
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly)) {
        return std::nullopt;
    }
    ReportFigure figure{.svg = file.readAll(), .size = {}, .caption = caption};
    figure.size = QSvgRenderer(figure.svg).defaultSize();
    return figure.size.isEmpty() ? std::nullopt : std::optional(std::move(figure));
}

// Labels are eight points high on paper, where the sheet is 174 mm wide and a figure takes `share`
// of it with so many units.
QFont figureFont(double width_units, double share)
{
    constexpr double kLabelPoints = 8.0;
    constexpr double kSheetPoints = 174.0 / 25.4 * 72.0;
    QFont font = QGuiApplication::font();
    font.setPixelSize(
        static_cast<int>(std::ceil(kLabelPoints * width_units / (share * kSheetPoints))));
    return font;
}

// Of paper, whatever the theme of the window is.
QPalette paperPalette()
{
    QPalette palette(QColor(240, 240, 240));
    palette.setColor(QPalette::Base, Qt::white);
    palette.setColor(QPalette::Text, QColor(29, 29, 31));
    palette.setColor(QPalette::Highlight, QColor(176, 58, 30));
    return palette;
}

std::optional<ReportFigure>
profileFigure(const MeasureItem& item, const Profile& profile, HeightUnit unit)
{
    ProfilePlot plot;
    plot.setPalette(paperPalette());
    plot.setFont(figureFont(ProfilePlot::pictureSize().width(), 1.0));
    plot.setHeightUnit(unit);
    ProfileCurve curve;
    curve.name = item.name;
    curve.color = QColor(176, 58, 30);
    curve.is_approximate = profile.is_approximate;
    curve.vertices_m = profile.vertices_m;
    for (const ProfilePoint& point : profile.points) {
        curve.distance_m.push_back(point.distance_m);
        curve.elevation_m.push_back(point.elevation_m);
    }
    plot.resize(ProfilePlot::pictureSize());
    plot.setCurves({std::move(curve)});
    plot.showEverything();
    // Drawn first: the axes get the size that they have in the figure.
    std::optional<ReportFigure> figure = figureOf(plot, {});
    if (figure) {
        const double factor = plot.drawnExaggeration();
        constexpr double kWhole = 10.0;
        //: Below a diagram; %1 is a number: elevations are drawn so many times larger than
        //: distances
        figure->caption = reportTr(QT_TRANSLATE_NOOP("Report", "Vertical exaggeration %1"))
                              .arg(numberText(factor, factor < kWhole ? 1 : 0));
    }
    return figure;
}

std::optional<ReportFigure> hypsometryFigure(const TerrainArea& area, HeightUnit unit)
{
    if (area.hypsometry.isEmpty()) {
        return std::nullopt;
    }
    HypsometryPlot plot;
    plot.setPalette(paperPalette());
    plot.setFont(figureFont(HypsometryPlot::pictureSize().width(), 1.0));
    plot.setHeightUnit(unit);
    plot.setHypsometry(area.hypsometry, area.is_approximate);
    return figureOf(plot, reportTr(QT_TRANSLATE_NOOP(
                              "Report",
                              "Area by classes of elevation (bars), and the share of the area that "
                              "lies above an elevation (line)")));
}

std::optional<ReportLegend> legendOf(const LegendContent& content)
{
    ReportLegend legend;
    if (content.contour_interval_m > 0.0) {
        //: %1 is the elevation from one contour line to the next
        legend.contours = reportTr(QT_TRANSLATE_NOOP("Report", "Contours every %1"))
                              .arg(lengthText(content.contour_interval_m));
    }
    const bool is_slope = content.mode == ShadingMode::Slope;
    double low =
        is_slope ? content.slopes.minimum.degrees() : inUnit(content.range.minimum_m, content.unit);
    double high =
        is_slope ? content.slopes.maximum.degrees() : inUnit(content.range.maximum_m, content.unit);
    if (content.ramp == nullptr || content.mode == ShadingMode::Hillshade || !(high > low)) {
        return legend.contours.isEmpty() ? std::nullopt : std::optional(legend);
    }
    RoundTicks ticks = roundTicks(low, high, kLegendTicksMost);
    const bool is_long = !is_slope && content.unit == HeightUnit::Meters && ticks.step >= 1000.0;
    const double kilo = is_long ? 1000.0 : 1.0;
    for (const double value : ticks.values) {
        legend.ticks.append({.share = (value - low) / (high - low),
                             .text = numberText(value / kilo, ticks.step / kilo)});
    }
    const auto colors = sampledRamp(*content.ramp);
    for (int i = 0; i < kLegendColors; ++i) {
        const Rgb8& color = colors[static_cast<std::size_t>(i) * (colors.size() - 1) /
                                   static_cast<std::size_t>(kLegendColors - 1)];
        legend.colors.append(QColor(color.red, color.green, color.blue));
    }
    legend.title = is_slope ? reportTr(QT_TRANSLATE_NOOP("Report", "Slope (°)"))
                            //: %1 is a unit
                            : reportTr(QT_TRANSLATE_NOOP("Report", "Elevation (%1)"))
                                  .arg(is_long ? QStringLiteral("km") : unitSymbol(content.unit));
    if (!is_slope && !content.datum.isEmpty()) {
        legend.title += QStringLiteral(", ") + content.datum;
    }
    return legend;
}

QString bodyAndCrs(const Map& map)
{
    const RasterInfo& info = map.info();
    QStringList parts;
    if (info.body != nullptr) {
        parts.append(bodyName(*info.body));
    }
    if (info.crs) {
        parts.append(QString::fromStdString(info.crs->name()));
    }
    return parts.join(QStringLiteral(" · "));
}

// Of what the picture shows.
QString bodyAndCrs(const PictureFacts& facts)
{
    const Map& map = *facts.maps.front();
    return facts.is_on_body ? bodyName(*map.info().body) : bodyAndCrs(map);
}

ReportMap mapOf(const ReportSource& source, const QSize& picture)
{
    const PictureFacts& facts = source.map;
    ReportMap made;
    made.legend = legendOf(facts.legend);
    if (const auto bar = scaleBar(facts.pixel_m, kScaleShareMax * picture.width())) {
        made.scale = ReportScale{.text = lengthText(bar->length_m),
                                 .share = bar->width_px / picture.width()};
    }
    made.north_deg = -facts.heading.degrees();
    //: Below a map; %1 is the position in its middle, %2 a body and a CRS, %3 a factor
    made.caption =
        reportTr(QT_TRANSLATE_NOOP("Report",
                                   "The view in the window, with %1 in its middle. %2. "
                                   "Vertical exaggeration ×%3"))
            .arg(positionText(source.format, *facts.maps.front(), facts.middle, facts.pixel_m),
                 bodyAndCrs(facts), shortNumberText(source.exaggeration, 3));
    return made;
}

ReportSection layersSection(const ReportSource& source)
{
    ReportSection section{.title = reportTr(QT_TRANSLATE_NOOP("Report", "Layers"))};
    ReportTable table{.header = {reportTr(QT_TRANSLATE_NOOP("Report", "Layer")),
                                 reportTr(QT_TRANSLATE_NOOP("Report", "Body and CRS")),
                                 reportTr(QT_TRANSLATE_NOOP("Report", "Samples")),
                                 reportTr(QT_TRANSLATE_NOOP("Report", "Pixel")),
                                 reportTr(QT_TRANSLATE_NOOP("Report", "Elevations"))}};
    for (const Layer& layer : source.session.layers) {
        if (std::find(source.map.maps.begin(), source.map.maps.end(), layer.map) ==
            source.map.maps.end()) {
            continue;
        }
        const Map& map = *layer.map;
        const RasterInfo& info = map.info();
        const Georeference georeference = georeferenceOf(info); // a preview's pixels are larger
        QString elevations;
        if (const auto range = map.heightfield().range()) {
            elevations = heightRangeText(*range, source.unit);
        }
        if (const QString datum = datumText(info); !datum.isEmpty()) {
            elevations += QStringLiteral(" (%1)").arg(datum);
        }
        table.rows.append(
            {QString::fromStdString(layer.name), bodyAndCrs(map),
             QStringLiteral("%1 × %2").arg(countText(info.columns), countText(info.rows)),
             QStringLiteral("%1 × %2 m")
                 .arg(shortNumberText(georeference.pixelWidthMeters(), 6),
                      shortNumberText(georeference.pixelHeightMeters(), 6)),
             elevations});
    }
    section.table = std::move(table);
    return section;
}

QString layerName(const ReportSource& source, const MeasureItem& item)
{
    const Layer* layer = layerOf(source.session, item.layer);
    return layer != nullptr ? QString::fromStdString(layer->name) : QString();
}

// A line of a table for each, in the order in which they were made.
ReportSection overviewSection(const ReportSource& source)
{
    ReportSection section{.title = reportTr(QT_TRANSLATE_NOOP("Report", "Measurements"))};
    ReportTable table{.header = {reportTr(QT_TRANSLATE_NOOP("Report", "Name")),
                                 reportTr(QT_TRANSLATE_NOOP("Report", "Kind")),
                                 reportTr(QT_TRANSLATE_NOOP("Report", "Result")),
                                 reportTr(QT_TRANSLATE_NOOP("Report", "Layer")),
                                 reportTr(QT_TRANSLATE_NOOP("Report", "Note"))}};
    for (const MeasureItem& item : source.measuring.state().items) {
        const MeasureOutcome& outcome = source.measuring.outcome(item.id);
        if (outcome.result) {
            table.rows.append({item.name, measurementName(item.kind),
                               outcome.result->values
                                   ? measureTableText(*outcome.result, source.unit)
                                   : asSentence(outcome.result->values.error().message),
                               layerName(source, item), item.note});
        }
    }
    section.table = std::move(table);
    return section;
}

// The points with their positions: one among the facts, several as a table.
void addPoints(ReportSection& section,
               const ReportSource& source,
               const MeasureItem& item,
               const MeasurementResult& result)
{
    const Layer* layer = layerOf(source.session, item.layer);
    if (layer == nullptr) {
        return;
    }
    const std::vector<MeasurePoint> points =
        measurePoints(item.vertices, result, *layer->map, source.format, source.unit);
    std::vector<MeasureRow> facts = centerRows(result, *layer->map, source.format);
    if (points.size() == 1) {
        facts = pointRows(points);
    } else {
        ReportTable table{.header = {reportTr(QT_TRANSLATE_NOOP("Report", "Point")),
                                     reportTr(QT_TRANSLATE_NOOP("Report", "Position")),
                                     reportTr(QT_TRANSLATE_NOOP("Report", "Elevation"))}};
        for (std::size_t i = 0; i < points.size(); ++i) {
            table.rows.append({countText(i + 1), points[i].position, points[i].elevation});
        }
        section.table = std::move(table);
    }
    for (const MeasureRow& fact : facts) {
        section.facts.append({.label = fact.label, .value = fact.value});
    }
}

ReportSection
measurementSection(const ReportSource& source, const MeasureItem& item, bool has_plots)
{
    const MeasureOutcome& outcome = source.measuring.outcome(item.id);
    //: Heading: %1 is a measurement, %2 its kind
    ReportSection section{.title = reportTr(QT_TRANSLATE_NOOP("Report", "%1 (%2)"))
                                       .arg(item.name, measurementName(item.kind)),
                          .note = item.note};
    for (const MeasureRow& row : measureRows(*outcome.result, source.unit)) {
        section.facts.append({.label = row.label, .value = row.value});
    }
    addPoints(section, source, item, *outcome.result);
    if (const auto* profile = outcome.as<Profile>(); profile != nullptr && has_plots) {
        if (auto figure = profileFigure(item, *profile, source.unit)) {
            section.figures.append(std::move(*figure));
        }
    }
    if (const auto* area = outcome.as<TerrainArea>(); area != nullptr && has_plots) {
        if (auto figure = hypsometryFigure(*area, source.unit)) {
            section.figures.append(std::move(*figure));
        }
    }
    return section;
}

// A line of a table for each annotation on the body of the map, in the order in which they were
// drawn.
std::optional<ReportSection> annotationsSection(const ReportSource& source)
{
    constexpr qsizetype kRowsMax = 2000; // more are no report: they can be exported
    ReportTable table{.header = {reportTr(QT_TRANSLATE_NOOP("Report", "Name")),
                                 reportTr(QT_TRANSLATE_NOOP("Report", "Kind")),
                                 reportTr(QT_TRANSLATE_NOOP("Report", "Position")),
                                 reportTr(QT_TRANSLATE_NOOP("Report", "Note"))}};
    std::size_t count = 0;
    for (const AnnotationItem& item : source.annotating.state().items) {
        if (!item.isComplete() || !source.annotating.isShown(item)) {
            continue;
        }
        if (++count; table.rows.size() < kRowsMax) {
            QString position =
                positionText(source.format, *source.map.maps.front(), item.vertices.front());
            if (!item.isSingle()) {
                //: Of a line or border: %1 is the position of its first point
                position = reportTr(QT_TRANSLATE_NOOP("Report", "from %1")).arg(position);
            }
            table.rows.append({item.name, shapeText(item.shape), position, item.note});
        }
    }
    if (table.rows.isEmpty()) {
        return std::nullopt;
    }
    ReportSection section{.title = reportTr(QT_TRANSLATE_NOOP("Report", "Annotations"))};
    if (const auto shown = static_cast<std::size_t>(table.rows.size()); count > shown) {
        //: %1 and %2 are numbers
        section.note = reportTr(QT_TRANSLATE_NOOP("Report", "The first %1 of %2 annotations"))
                           .arg(countText(shown), countText(count));
    }
    section.table = std::move(table);
    return section;
}

std::optional<ReportSection> attitudesSection(const ReportSource& source)
{
    std::vector<NetPlane> planes;
    for (const MeasureItem& item : source.measuring.state().items) {
        if (const auto* attitude = source.measuring.outcome(item.id).as<Attitude>()) {
            planes.push_back({.id = item.id,
                              .name = item.name,
                              .plane = orientationOf(*attitude),
                              .ellipse = poleEllipse(*attitude)});
        }
    }
    if (planes.empty()) {
        return std::nullopt;
    }
    StereonetPlot plot;
    plot.setFont(figureFont(StereonetPlot::pictureSize().width(), 0.5));
    plot.setPlanes(std::move(planes), 0);
    const bool has_mean = plot.statistics()->count > 1;
    auto figure = figureOf(
        plot, has_mean
                  ? reportTr(QT_TRANSLATE_NOOP(
                        "Report",
                        "Equal-area net of the lower hemisphere: planes, poles, and their 95 % "
                        "confidence; dotted: the mean plane, with its pole in a ring"))
                  : reportTr(QT_TRANSLATE_NOOP(
                        "Report",
                        "Equal-area net of the lower hemisphere: planes, poles, and their 95 % "
                        "confidence")));
    if (!figure) {
        return std::nullopt;
    }
    ReportSection section{.title = reportTr(QT_TRANSLATE_NOOP("Report", "Attitudes"))};
    if (has_mean) {
        section.note = orientationLines(*plot.statistics()).join(QStringLiteral(" · "));
    }
    section.figures.append(std::move(*figure));
    return section;
}

void addMeasurements(Report& report, const ReportSource& source, const ReportChoice& choice)
{
    ReportSection overview = overviewSection(source);
    if (overview.table->rows.isEmpty()) {
        return;
    }
    report.sections.append(std::move(overview));
    for (const MeasureItem& item : source.measuring.state().items) {
        const MeasureOutcome& outcome = source.measuring.outcome(item.id);
        if (outcome.result && outcome.result->values) {
            report.sections.append(measurementSection(source, item, choice.has_plots));
        }
    }
    if (choice.has_plots) {
        if (auto attitudes = attitudesSection(source)) {
            report.sections.append(std::move(*attitudes));
        }
    }
}

} // namespace

Report reportOf(const ReportSource& source, const ReportChoice& choice, const QSize& picture)
{
    const QDateTime now = QDateTime::currentDateTime();
    Report report{
        .title = choice.title, .subtitle = bodyAndCrs(source.map), .credit = choice.credit};
    //: At the foot of a report; %1 is a version, %2 a date
    report.made_by = reportTr(QT_TRANSLATE_NOOP("Report", "Made with MarsView %1, %2"))
                         .arg(QCoreApplication::applicationVersion(),
                              QLocale().toString(now.date(), QLocale::LongFormat));
    report.map = mapOf(source, picture);
    report.sections.append(layersSection(source));
    if (choice.has_measurements) {
        addMeasurements(report, source, choice);
    }
    if (choice.has_annotations) {
        if (auto annotations = annotationsSection(source)) {
            report.sections.append(std::move(*annotations));
        }
    }
    return report;
}

} // namespace marsview
