#include "ui/plots/profile_plot.h"

#include "ui/plots/custom_plot.h"
#include "ui/plots/number_ticker.h"
#include "ui/plots/plot_look.h"

#include <QEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QResizeEvent>
#include <QScopeGuard>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace marsview {
namespace {

constexpr double kDragLeast = 4.0; // pixels: less is a click
constexpr int kTicksMax = 6;
constexpr int kNameWidthMax = 180; // points: longer names are cut
constexpr int kLegendMargins = 24; // points above and below all names
constexpr QSize kPictureSize{1200, 500};
constexpr double kPictureScale = 2.0;

// Distances below this are labeled in meters, others in kilometers.
constexpr double kKilometersFrom = 5000.0;

struct Extent {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(double value)
    {
        if (std::isfinite(value)) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    bool isEmpty() const { return !(low <= high); }
    // With room at the ends, and never a point.
    QCPRange padded(double share) const
    {
        const double room = std::max((high - low) * share, high > low ? 0.0 : 1.0);
        return {low - room, high + room};
    }
};

} // namespace

struct ProfilePlot::Parts {
    QCustomPlot* plot = nullptr;
    QCPItemStraightLine* cursor_line = nullptr;
    QCPItemTracer* cursor_dot = nullptr;
    QCPItemText* cursor_text = nullptr;
    QCPItemRect* stretch = nullptr;
    QCPGraph* slope = nullptr;
    std::vector<QCPItemStraightLine*> bends;
    Extent distances; // in the unit of the axis
    Extent heights;
    double distance_unit_m = 1.0;
    QString elevation_title;
};

ProfilePlot::ProfilePlot(QWidget* parent)
    : QWidget(parent)
    , parts_(std::make_unique<Parts>())
{
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Profile"));
    setAccessibleDescription(tr("The left and right arrow keys move the cursor along the profile"));
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    auto* plot = new QCustomPlot(this);
    layout->addWidget(plot);
    plot->setMinimumSize(160, 90);
    plot->setInteractions(QCP::iRangeZoom);
    plot->axisRect()->setRangeZoom(Qt::Horizontal);
    plot->setMouseTracking(true);
    plot->installEventFilter(this);
    setFocusProxy(nullptr);
    for (QCPAxis* axis : {plot->xAxis, plot->yAxis, plot->yAxis2}) {
        axis->setTicker(QSharedPointer<NumberTicker>::create());
        axis->ticker()->setTickCount(kTicksMax);
    }
    parts_->plot = plot;
    parts_->stretch = new QCPItemRect(plot);
    parts_->stretch->topLeft->setTypeY(QCPItemPosition::ptAxisRectRatio);
    parts_->stretch->bottomRight->setTypeY(QCPItemPosition::ptAxisRectRatio);
    parts_->cursor_line = new QCPItemStraightLine(plot);
    parts_->cursor_dot = new QCPItemTracer(plot);
    parts_->cursor_dot->setStyle(QCPItemTracer::tsCircle);
    parts_->cursor_dot->setSize(7.0);
    parts_->cursor_text = new QCPItemText(plot);
    parts_->cursor_text->position->setTypeX(QCPItemPosition::ptPlotCoords);
    parts_->cursor_text->position->setTypeY(QCPItemPosition::ptAxisRectRatio);
    parts_->cursor_text->setPadding(QMargins(6, 2, 6, 2));
    connect(plot->xAxis, qOverload<const QCPRange&>(&QCPAxis::rangeChanged), this, [this] {
        const QCPRange all =
            parts_->distances.isEmpty() ? QCPRange(0.0, 1.0) : parts_->distances.padded(0.0);
        if (!exaggeration_) {
            parts_->plot->xAxis->setRange(
                parts_->plot->xAxis->range().bounded(all.lower, all.upper));
        }
        placeCursor();
    });
    applyColors();
    placeCursor();
    placeStretch();
}

ProfilePlot::~ProfilePlot() = default;

void ProfilePlot::setCurves(std::vector<ProfileCurve> curves)
{
    const Extent before = parts_->distances;
    curves_ = std::move(curves);
    fillGraphs();
    applyColors();
    if (parts_->distances.low != before.low || parts_->distances.high != before.high) {
        setStretch(std::nullopt);
        showEverything();
    } else {
        applyScale();
    }
    placeCursor();
}

void ProfilePlot::setHeightUnit(HeightUnit unit)
{
    unit_ = unit;
    setCurves(std::move(curves_));
}

void ProfilePlot::fillGraphs()
{
    QCustomPlot& plot = *parts_->plot;
    plot.clearGraphs();
    parts_->slope = nullptr;
    parts_->cursor_dot->setGraph(nullptr);
    for (QCPItemStraightLine* bend : std::exchange(parts_->bends, {})) {
        plot.removeItem(bend);
    }
    double longest_m = 0.0;
    for (const ProfileCurve& curve : curves_) {
        longest_m = std::max(longest_m, curve.distance_m.empty() ? 0.0 : curve.distance_m.back());
    }
    parts_->distance_unit_m = longest_m >= kKilometersFrom ? 1000.0 : 1.0;
    parts_->distances = {};
    parts_->heights = {};
    for (const ProfileCurve& curve : curves_) {
        QCPGraph* graph = plot.addGraph();
        graph->setName(QFontMetrics(font()).elidedText(curve.name, Qt::ElideMiddle, kNameWidthMax));
        QVector<QCPGraphData> points;
        points.reserve(static_cast<qsizetype>(curve.distance_m.size()));
        for (std::size_t i = 0; i < curve.distance_m.size(); ++i) {
            const double x = curve.distance_m[i] / parts_->distance_unit_m;
            const double y = inUnit(curve.elevation_m[i], unit_);
            parts_->distances.add(x);
            parts_->heights.add(y);
            points.append({x, y});
        }
        graph->data()->set(points, true);
    }
    if (!curves_.empty()) {
        for (const double bend_m : curves_.front().vertices_m) {
            auto* bend = new QCPItemStraightLine(&plot);
            bend->point1->setCoords(bend_m / parts_->distance_unit_m, 0.0);
            bend->point2->setCoords(bend_m / parts_->distance_unit_m, 1.0);
            parts_->bends.push_back(bend);
        }
        parts_->slope = plot.addGraph(plot.xAxis, plot.yAxis2);
        parts_->slope->setLineStyle(QCPGraph::lsStepLeft);
        const ProfileCurve& first = curves_.front();
        QVector<QCPGraphData> slopes;
        for (std::size_t i = 1; i < first.distance_m.size(); ++i) {
            const double run = first.distance_m[i] - first.distance_m[i - 1];
            const double rise = first.elevation_m[i] - first.elevation_m[i - 1];
            if (run > 0.0) {
                slopes.append({first.distance_m[i - 1] / parts_->distance_unit_m,
                               std::atan2(rise, run) * 180.0 / std::numbers::pi});
            }
        }
        parts_->slope->data()->set(slopes, true);
        parts_->slope->rescaleValueAxis();
        parts_->slope->removeFromLegend();
    }
    placeLegend();
    const bool is_kilometers = parts_->distance_unit_m > 1.0;
    plot.xAxis->setLabel(is_kilometers ? tr("Distance (km)") : tr("Distance (m)"));
    const bool is_approximate =
        std::any_of(curves_.begin(), curves_.end(),
                    [](const ProfileCurve& curve) { return curve.is_approximate; });
    parts_->elevation_title =
        (is_approximate ? tr("Elevation (%1), approximate") : tr("Elevation (%1)"))
            .arg(unitSymbol(unit_));
    fitAxes(plot.height());
    setSlopeShown(is_slope_shown_);
}

// The names of several curves are to the right of the diagram, where they cover no curve.
void ProfilePlot::placeLegend()
{
    QCustomPlot& plot = *parts_->plot;
    QCPLegend* legend = plot.legend;
    const bool is_shown = curves_.size() > 1;
    const bool is_to_the_right = plot.plotLayout()->columnCount() > 1;
    legend->setVisible(is_shown);
    if (is_shown == is_to_the_right) {
        return;
    }
    constexpr double kLeastStretch = 0.001;
    legend->layout()->take(legend);
    if (is_shown) {
        auto* column = new QCPLayoutGrid;
        plot.plotLayout()->addElement(0, 1, column);
        plot.plotLayout()->setColumnStretchFactor(1, kLeastStretch);
        column->addElement(0, 0, legend);
        column->addElement(1, 0, new QCPLayoutElement(&plot)); // the room below
        column->setRowStretchFactor(0, kLeastStretch);
    } else {
        plot.axisRect()->insetLayout()->addElement(legend, Qt::AlignTop | Qt::AlignRight);
        plot.plotLayout()->remove(plot.plotLayout()->element(0, 1));
        plot.plotLayout()->simplify(); // gives its column to the diagram
    }
}

// As many names below each other as there is room for, the others next to them.
void ProfilePlot::fitLegend(int height)
{
    QCPLegend& legend = *parts_->plot->legend;
    const int row = std::max(QFontMetrics(legend.font()).height(), legend.iconSize().height());
    const int rows = std::max(1, (height - kLegendMargins) / std::max(1, row));
    legend.setWrap(rows);
    legend.setFillOrder(QCPLegend::foRowsFirst);
}

void ProfilePlot::applyColors()
{
    const QPalette& colors = palette();
    QCustomPlot& plot = *parts_->plot;
    paintAxes(plot, {plot.xAxis, plot.yAxis, plot.yAxis2}, colors, font());
    const PlotInk ink = plotInk(colors);
    for (QCPAxis* axis : {plot.xAxis, plot.yAxis, plot.yAxis2}) {
        axis->grid()->setZeroLinePen(QPen(ink.faint));
    }
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        plot.graph(static_cast<int>(i))->setPen(QPen(curves_[i].color, 1.8));
    }
    if (parts_->slope != nullptr) {
        QColor slope = ink.text;
        slope.setAlpha(110);
        parts_->slope->setPen(QPen(slope, 1.0));
    }
    for (QCPItemStraightLine* bend : parts_->bends) {
        bend->setPen(QPen(ink.faint, 1.0, Qt::DashLine));
    }
    parts_->cursor_line->setPen(QPen(ink.text, 1.0));
    parts_->cursor_dot->setPen(QPen(ink.text, 1.5));
    parts_->cursor_dot->setBrush(colors.color(QPalette::Base));
    paintCursorText(*parts_->cursor_text, colors, font());
    QColor behind_names = colors.color(QPalette::Base);
    behind_names.setAlpha(200);
    plot.legend->setBrush(behind_names);
    plot.legend->setBorderPen(Qt::NoPen);
    plot.legend->setTextColor(ink.text);
    plot.legend->setFont(font());
    plot.legend->setMargins(QMargins(4, 2, 4, 2));
    plot.legend->setRowSpacing(0);
    QColor picked = colors.color(QPalette::Highlight);
    picked.setAlpha(60);
    parts_->stretch->setBrush(picked);
    parts_->stretch->setPen(QPen(colors.color(QPalette::Highlight)));
    plot.replot(QCustomPlot::rpQueuedReplot);
}

void ProfilePlot::showEverything()
{
    QCustomPlot& plot = *parts_->plot;
    if (parts_->distances.isEmpty()) {
        plot.xAxis->setRange(0.0, 1.0);
        plot.yAxis->setRange(0.0, 1.0);
    } else {
        plot.xAxis->setRange(parts_->distances.padded(0.0));
    }
    applyScale();
}

void ProfilePlot::setExaggeration(std::optional<double> factor)
{
    exaggeration_ = factor;
    showEverything();
}

// Elevations fill the plot, or are drawn in proportion to distances: then the side with room to
// spare shows more than there is.
void ProfilePlot::applyScale()
{
    QCustomPlot& plot = *parts_->plot;
    if (!parts_->heights.isEmpty()) {
        plot.yAxis->setRange(parts_->heights.padded(0.06));
        if (exaggeration_) {
            plot.replot(QCustomPlot::rpImmediateRefresh); // lays the axes out
            const double height_unit_m = 1.0 / inUnit(1.0, unit_);
            const QSize size = plot.axisRect()->size();
            const QCPRange x = plot.xAxis->range();
            const QCPRange y = plot.yAxis->range();
            const double m_per_px =
                std::max(x.size() * parts_->distance_unit_m / std::max(1, size.width()),
                         y.size() * height_unit_m * *exaggeration_ / std::max(1, size.height()));
            plot.yAxis->setRange(y.center(),
                                 m_per_px * size.height() / *exaggeration_ / height_unit_m,
                                 Qt::AlignCenter);
            plot.xAxis->setRange(x.center(), m_per_px * size.width() / parts_->distance_unit_m,
                                 Qt::AlignCenter);
        }
    }
    plot.replot(QCustomPlot::rpQueuedReplot);
}

double ProfilePlot::drawnExaggeration() const
{
    const QCustomPlot& plot = *parts_->plot;
    const QSize size = plot.axisRect()->size();
    const double x_m = plot.xAxis->range().size() * parts_->distance_unit_m;
    const double y_m = plot.yAxis->range().size() / inUnit(1.0, unit_);
    if (curves_.empty() || size.isEmpty() || !(x_m > 0.0) || !(y_m > 0.0)) {
        return 1.0;
    }
    return size.height() / y_m / (size.width() / x_m);
}

void ProfilePlot::setSlopeShown(bool is_shown)
{
    is_slope_shown_ = is_shown;
    parts_->plot->yAxis2->setVisible(is_shown);
    if (parts_->slope != nullptr) {
        parts_->slope->setVisible(is_shown);
    }
    parts_->plot->replot(QCustomPlot::rpQueuedReplot);
}

// NaN in gaps and beyond the ends.
double ProfilePlot::elevationAt(double distance_m) const
{
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    if (curves_.empty()) {
        return kNan;
    }
    const ProfileCurve& curve = curves_.front();
    const auto after =
        std::lower_bound(curve.distance_m.begin(), curve.distance_m.end(), distance_m);
    if (after == curve.distance_m.end()) {
        return kNan;
    }
    const auto i = static_cast<std::size_t>(after - curve.distance_m.begin());
    if (*after == distance_m) {
        return curve.elevation_m[i];
    }
    if (i == 0) {
        return kNan;
    }
    const double share =
        (distance_m - curve.distance_m[i - 1]) / (*after - curve.distance_m[i - 1]);
    return std::lerp(curve.elevation_m[i - 1], curve.elevation_m[i], share);
}

void ProfilePlot::setCursorAt(std::optional<double> distance_m)
{
    cursor_m_ = distance_m;
    placeCursor();
    parts_->plot->replot(QCustomPlot::rpQueuedReplot);
}

void ProfilePlot::placeCursor()
{
    const bool is_shown = cursor_m_.has_value() && !curves_.empty();
    parts_->cursor_line->setVisible(is_shown);
    parts_->cursor_text->setVisible(is_shown);
    parts_->cursor_dot->setVisible(false);
    if (!is_shown) {
        return;
    }
    const double x = *cursor_m_ / parts_->distance_unit_m;
    parts_->cursor_line->point1->setCoords(x, 0.0);
    parts_->cursor_line->point2->setCoords(x, 1.0);
    const double elevation_m = elevationAt(*cursor_m_);
    if (std::isfinite(elevation_m)) {
        parts_->cursor_dot->setVisible(true);
        parts_->cursor_dot->position->setCoords(x, inUnit(elevation_m, unit_));
    }
    const QCPRange shown = parts_->plot->xAxis->range();
    const bool is_right = x > shown.center();
    parts_->cursor_text->setPositionAlignment(Qt::AlignTop |
                                              (is_right ? Qt::AlignRight : Qt::AlignLeft));
    parts_->cursor_text->position->setCoords(x, 0.02);
    const double resolution = shown.size() / std::max(1, parts_->plot->axisRect()->width());
    const QString distance =
        withUnit(numberText(x, decimalsFor(resolution * 10.0, 6)),
                 parts_->distance_unit_m > 1.0 ? QStringLiteral("km") : QStringLiteral("m"));
    const QString elevation =
        std::isfinite(elevation_m)
            ? withUnit(numberText(inUnit(elevation_m, unit_),
                                  decimalsFor(parts_->plot->yAxis->range().size() / 100.0, 3)),
                       unitSymbol(unit_))
            : tr("no data");
    parts_->cursor_text->setText(tr("%1 at %2").arg(elevation, distance));
}

void ProfilePlot::setStretch(const std::optional<DistanceRange>& stretch)
{
    stretch_ = stretch;
    placeStretch();
    parts_->plot->replot(QCustomPlot::rpQueuedReplot);
}

void ProfilePlot::placeStretch()
{
    parts_->stretch->setVisible(stretch_.has_value());
    if (stretch_) {
        parts_->stretch->topLeft->setCoords(stretch_->begin_m / parts_->distance_unit_m, 0.0);
        parts_->stretch->bottomRight->setCoords(stretch_->end_m / parts_->distance_unit_m, 1.0);
    }
}

void ProfilePlot::moveCursor(std::optional<double> distance_m)
{
    if (distance_m && !parts_->distances.isEmpty()) {
        distance_m = std::clamp(*distance_m, parts_->distances.low * parts_->distance_unit_m,
                                parts_->distances.high * parts_->distance_unit_m);
    }
    setCursorAt(distance_m);
    Q_EMIT cursorMoved(distance_m);
}

bool ProfilePlot::eventFilter(QObject* watched, QEvent* event)
{
    QCustomPlot& plot = *parts_->plot;
    if (watched == &plot && event->type() == QEvent::Resize) {
        fitAxes(static_cast<QResizeEvent&>(*event).size().height());
    }
    if (watched != &plot || curves_.empty()) {
        return QWidget::eventFilter(watched, event);
    }
    const auto distanceAt = [&](const QMouseEvent& mouse) {
        return std::clamp(plot.xAxis->pixelToCoord(mouse.position().x()), parts_->distances.low,
                          parts_->distances.high) *
               parts_->distance_unit_m;
    };
    const double pixel_m = plot.xAxis->range().size() * parts_->distance_unit_m /
                           std::max(1, plot.axisRect()->width());
    switch (event->type()) {
    case QEvent::MouseButtonPress: {
        const auto& mouse = static_cast<QMouseEvent&>(*event);
        setFocus(Qt::MouseFocusReason);
        if (mouse.button() == Qt::LeftButton) {
            dragged_from_m_ = distanceAt(mouse);
        }
        return true;
    }
    case QEvent::MouseMove: {
        const auto& mouse = static_cast<QMouseEvent&>(*event);
        const double at_m = distanceAt(mouse);
        if (dragged_from_m_ && std::abs(at_m - *dragged_from_m_) >= kDragLeast * pixel_m) {
            setStretch(
                DistanceRange{std::min(at_m, *dragged_from_m_), std::max(at_m, *dragged_from_m_)});
        }
        moveCursor(at_m);
        return true;
    }
    case QEvent::MouseButtonRelease: {
        const auto& mouse = static_cast<QMouseEvent&>(*event);
        if (mouse.button() == Qt::LeftButton && dragged_from_m_) {
            const double from_m = *std::exchange(dragged_from_m_, std::nullopt);
            if (std::abs(distanceAt(mouse) - from_m) < kDragLeast * pixel_m) {
                setStretch(std::nullopt);
            }
            Q_EMIT stretchPicked(stretch_);
        }
        return true;
    }
    case QEvent::MouseButtonDblClick:
        showEverything();
        return true;
    case QEvent::Leave:
        moveCursor(std::nullopt);
        return false;
    default:
        return QWidget::eventFilter(watched, event);
    }
}

// Numbers on top of each other cannot be read, nor titles that are cut: the unit alone is short.
void ProfilePlot::fitAxes(int height)
{
    constexpr int kBelow = 50; // points for the axis of distances
    constexpr int kTick = 26;  // points from one elevation to the next
    const int count = std::clamp((height - kBelow) / kTick, 2, kTicksMax);
    for (QCPAxis* axis : {parts_->plot->yAxis, parts_->plot->yAxis2}) {
        axis->ticker()->setTickCount(count);
    }
    const auto set_title = [&](QCPAxis& axis, const QString& title, const QString& unit) {
        const int length = QFontMetrics(axis.labelFont()).horizontalAdvance(title);
        axis.setLabel(length <= height - kBelow ? title : unit);
    };
    set_title(*parts_->plot->yAxis, parts_->elevation_title, unitSymbol(unit_));
    set_title(*parts_->plot->yAxis2, tr("Slope (°)"), QStringLiteral("°"));
    fitLegend(height);
}

void ProfilePlot::keyPressEvent(QKeyEvent* event)
{
    const QCPRange shown = parts_->plot->xAxis->range();
    const double step_m = shown.size() * parts_->distance_unit_m /
                          (event->modifiers().testFlag(Qt::ShiftModifier) ? 20.0 : 200.0);
    const double from_m = cursor_m_.value_or(shown.lower * parts_->distance_unit_m);
    switch (event->key()) {
    case Qt::Key_Left:
        moveCursor(from_m - step_m);
        break;
    case Qt::Key_Right:
        moveCursor(from_m + step_m);
        break;
    case Qt::Key_Home:
        moveCursor(parts_->distances.low * parts_->distance_unit_m);
        break;
    case Qt::Key_End:
        moveCursor(parts_->distances.high * parts_->distance_unit_m);
        break;
    default:
        QWidget::keyPressEvent(event);
    }
}

void ProfilePlot::changeEvent(QEvent* event)
{
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) {
        applyColors();
    }
    QWidget::changeEvent(event);
}

QSize ProfilePlot::pictureSize()
{
    return kPictureSize;
}

bool ProfilePlot::savePicture(const QString& path)
{
    fitAxes(kPictureSize.height());
    const auto fit_again = qScopeGuard([this] { fitAxes(parts_->plot->height()); });
    return savePlot(*parts_->plot, path, kPictureSize, kPictureScale, tr("Profile"));
}

} // namespace marsview
