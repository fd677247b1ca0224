#include "ui/plots/hypsometry_plot.h"

#include "ui/plots/custom_plot.h"
#include "ui/plots/number_ticker.h"
#include "ui/plots/plot_look.h"

#include <QEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

constexpr QSize kHypsometrySize{900, 600};
constexpr double kHypsometryScale = 2.0;
constexpr std::size_t kBarsMax = 40;
constexpr double kSquareKilometersFrom = 1e6; // areas below are labeled in square meters
constexpr double kBarShare = 0.92;            // of the width of a class

// "20 %".
class PercentTicker final : public QCPAxisTicker {
public:
    QString
    getTickLabel(double tick, const QLocale& /*locale*/, QChar /*format*/, int precision) override
    {
        return withUnit(shortNumberText(tick, precision), QStringLiteral("%"));
    }
};

} // namespace

struct HypsometryPlot::Parts {
    QCustomPlot* plot = nullptr;
    QCPBars* bars = nullptr;
    QCPGraph* curve = nullptr;
    QCPItemStraightLine* cursor_line = nullptr;
    QCPItemText* cursor_text = nullptr;
};

HypsometryPlot::HypsometryPlot(QWidget* parent)
    : QWidget(parent)
    , parts_(std::make_unique<Parts>())
{
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Hypsometry"));
    setAccessibleDescription(
        tr("The up and down arrow keys read the share of the area above an elevation"));
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    auto* plot = new QCustomPlot(this);
    layout->addWidget(plot);
    plot->setMinimumSize(160, 90);
    plot->setMouseTracking(true);
    plot->installEventFilter(this);
    plot->xAxis2->setVisible(true);
    for (QCPAxis* axis : {plot->xAxis, plot->yAxis}) {
        axis->setTicker(QSharedPointer<NumberTicker>::create());
        axis->ticker()->setTickCount(5);
    }
    plot->xAxis2->setTicker(QSharedPointer<PercentTicker>::create());
    parts_->plot = plot;
    parts_->bars = new QCPBars(plot->yAxis, plot->xAxis);
    parts_->curve = plot->addGraph(plot->yAxis, plot->xAxis2);
    parts_->cursor_line = new QCPItemStraightLine(plot);
    parts_->cursor_text = new QCPItemText(plot);
    parts_->cursor_text->position->setTypeX(QCPItemPosition::ptAxisRectRatio);
    parts_->cursor_text->setPadding(QMargins(6, 2, 6, 2));
    applyColors();
    fill();
}

HypsometryPlot::~HypsometryPlot() = default;

void HypsometryPlot::setHypsometry(const Hypsometry& hypsometry, bool is_approximate)
{
    hypsometry_ = hypsometry;
    classes_ = withFewerClasses(hypsometry, kBarsMax);
    is_approximate_ = is_approximate;
    fill();
}

void HypsometryPlot::setHeightUnit(HeightUnit unit)
{
    unit_ = unit;
    fill();
}

void HypsometryPlot::fill()
{
    QCustomPlot& plot = *parts_->plot;
    const double total_m2 = hypsometry_.totalM2();
    double most_m2 = 0.0;
    for (const double area_m2 : classes_.area_m2) {
        most_m2 = std::max(most_m2, area_m2);
    }
    const bool is_large = most_m2 >= kSquareKilometersFrom;
    const double area_unit_m2 = is_large ? 1e6 : 1.0;
    QVector<QCPBarsData> bars;
    for (std::size_t i = 0; i < classes_.area_m2.size(); ++i) {
        bars.append({inUnit(classes_.boundM(i) + 0.5 * classes_.step_m, unit_),
                     classes_.area_m2[i] / area_unit_m2});
    }
    parts_->bars->setWidth(kBarShare * std::abs(inUnit(classes_.step_m, unit_)));
    parts_->bars->data()->set(bars, true);
    QVector<QCPGraphData> curve;
    if (total_m2 > 0.0) {
        double above_m2 = total_m2;
        for (std::size_t i = 0; i <= hypsometry_.area_m2.size(); ++i) {
            curve.append({inUnit(hypsometry_.boundM(i), unit_),
                          100.0 * std::clamp(above_m2 / total_m2, 0.0, 1.0)});
            above_m2 -= i < hypsometry_.area_m2.size() ? hypsometry_.area_m2[i] : 0.0;
        }
    }
    parts_->curve->data()->set(curve, true);
    plot.xAxis->setLabel(is_large ? tr("Bars: area (km²)") : tr("Bars: area (m²)"));
    plot.xAxis2->setLabel(tr("Line: share of the area above"));
    plot.yAxis->setLabel(
        (is_approximate_ ? tr("Elevation (%1), approximate") : tr("Elevation (%1)"))
            .arg(unitSymbol(unit_)));
    plot.xAxis->setRange(0.0, most_m2 > 0.0 ? 1.08 * most_m2 / area_unit_m2 : 1.0);
    plot.xAxis2->setRange(0.0, 100.0);
    if (classes_.isEmpty()) {
        plot.yAxis->setRange(0.0, 1.0);
    } else {
        plot.yAxis->setRange(inUnit(classes_.boundM(0), unit_),
                             inUnit(classes_.boundM(classes_.area_m2.size()), unit_));
    }
    placeCursor();
    plot.replot(QCustomPlot::rpQueuedReplot);
}

void HypsometryPlot::applyColors()
{
    const QPalette& colors = palette();
    QCustomPlot& plot = *parts_->plot;
    paintAxes(plot, {plot.xAxis, plot.xAxis2, plot.yAxis}, colors, font());
    // Half of the last number of an axis lies beyond its end; numbers that are cut are not drawn.
    const int beyond =
        QFontMetrics(plot.xAxis2->tickLabelFont()).horizontalAdvance(QStringLiteral("1,000,000"));
    plot.axisRect()->setMinimumMargins({0, 0, beyond / 2 + 2, 0});
    const PlotInk ink = plotInk(colors);
    QColor bar = ink.text;
    bar.setAlpha(70);
    parts_->bars->setPen(Qt::NoPen);
    parts_->bars->setBrush(bar);
    parts_->curve->setPen(QPen(colors.color(QPalette::Highlight), 1.8));
    parts_->cursor_line->setPen(QPen(ink.text, 1.0));
    paintCursorText(*parts_->cursor_text, colors, font());
    plot.replot(QCustomPlot::rpQueuedReplot);
}

void HypsometryPlot::setCursorAt(std::optional<double> elevation_m)
{
    if (elevation_m && !classes_.isEmpty()) {
        elevation_m =
            std::clamp(*elevation_m, classes_.boundM(0), classes_.boundM(classes_.area_m2.size()));
    }
    cursor_m_ = elevation_m;
    placeCursor();
    parts_->plot->replot(QCustomPlot::rpQueuedReplot);
}

QString HypsometryPlot::cursorText() const
{
    const double total_m2 = hypsometry_.totalM2();
    if (!cursor_m_ || !(total_m2 > 0.0)) {
        return {};
    }
    const double share = 100.0 * hypsometry_.areaAboveM2(*cursor_m_) / total_m2;
    constexpr double kRows = 200.0; // of the plot
    const QString elevation =
        withUnit(numberText(inUnit(*cursor_m_, unit_),
                            decimalsFor(parts_->plot->yAxis->range().size() / kRows, 3)),
                 unitSymbol(unit_));
    //: %1 is a share of the area in percent, %2 an elevation
    return tr("%1 above %2").arg(withUnit(numberText(share, 1), QStringLiteral("%")), elevation);
}

void HypsometryPlot::placeCursor()
{
    const QString text = cursorText();
    parts_->cursor_line->setVisible(!text.isEmpty());
    parts_->cursor_text->setVisible(!text.isEmpty());
    if (text.isEmpty()) {
        return;
    }
    const double y = inUnit(*cursor_m_, unit_);
    parts_->cursor_line->point1->setCoords(0.0, y);
    parts_->cursor_line->point2->setCoords(1.0, y);
    const bool is_high = y > parts_->plot->yAxis->range().center();
    parts_->cursor_text->setPositionAlignment(Qt::AlignRight |
                                              (is_high ? Qt::AlignTop : Qt::AlignBottom));
    parts_->cursor_text->position->setCoords(0.99, y);
    parts_->cursor_text->setText(text);
}

bool HypsometryPlot::eventFilter(QObject* watched, QEvent* event)
{
    QCustomPlot& plot = *parts_->plot;
    if (watched != &plot || classes_.isEmpty()) {
        return QWidget::eventFilter(watched, event);
    }
    switch (event->type()) {
    case QEvent::MouseButtonPress:
        setFocus(Qt::MouseFocusReason);
        return true;
    case QEvent::MouseMove: {
        const double shown =
            plot.yAxis->pixelToCoord(static_cast<QMouseEvent&>(*event).position().y());
        setCursorAt(shown / inUnit(1.0, unit_));
        return true;
    }
    case QEvent::Leave:
        setCursorAt(std::nullopt);
        return false;
    default:
        return QWidget::eventFilter(watched, event);
    }
}

void HypsometryPlot::keyPressEvent(QKeyEvent* event)
{
    if (classes_.isEmpty()) {
        QWidget::keyPressEvent(event);
        return;
    }
    const double low_m = classes_.boundM(0);
    const double high_m = classes_.boundM(classes_.area_m2.size());
    constexpr double kSteps = 100.0;
    const double step_m = (high_m - low_m) / kSteps;
    const double from_m = cursor_m_.value_or(low_m);
    switch (event->key()) {
    case Qt::Key_Up:
        setCursorAt(from_m + step_m);
        break;
    case Qt::Key_Down:
        setCursorAt(from_m - step_m);
        break;
    case Qt::Key_Home:
        setCursorAt(low_m);
        break;
    case Qt::Key_End:
        setCursorAt(high_m);
        break;
    default:
        QWidget::keyPressEvent(event);
    }
}

void HypsometryPlot::changeEvent(QEvent* event)
{
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) {
        applyColors();
    }
    QWidget::changeEvent(event);
}

QSize HypsometryPlot::pictureSize()
{
    return kHypsometrySize;
}

bool HypsometryPlot::savePicture(const QString& path)
{
    return savePlot(*parts_->plot, path, kHypsometrySize, kHypsometryScale, tr("Hypsometry"));
}

} // namespace marsview
