#include "ui/dialogs/stretch_plot.h"

#include "core/view/color_stretch.h"
#include "ui/text/ramp_text.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace marsview {
namespace {

constexpr int kMargin = 7; // left and right: room for the marks
constexpr int kMarkHeight = 7;
constexpr int kReach = 8;              // from a line, in which it can be dragged
constexpr double kTallestOfMean = 6.0; // a bar that is taller than this is cut
constexpr double kLeastShare = 1e-3;   // of the plot between the ends

} // namespace

StretchPlot::StretchPlot(QWidget* parent)
    : QWidget(parent)
{
    setAccessibleName(tr("Histogram"));
    setAccessibleDescription(tr("The lines mark the ends of the color stretch"));
    setToolTip(tr("Drag the lines to change the ends of the color stretch"));
    setMouseTracking(true);
}

void StretchPlot::setContent(const StretchPlotContent& content)
{
    content_ = content;
    update();
}

QRect StretchPlot::plot() const
{
    return rect().adjusted(kMargin, 2, -kMargin, -kMarkHeight - 2 - fontMetrics().height());
}

int StretchPlot::positionOf(double value) const
{
    const QRect area = plot();
    const double extent = content_.all.extent();
    const double share = extent > 0.0 ? (value - content_.all.low) / extent : 0.5;
    return area.left() +
           static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * (area.width() - 1)));
}

double StretchPlot::valueAt(int x) const
{
    const QRect area = plot();
    const double share = static_cast<double>(x - area.left()) / std::max(1, area.width() - 1);
    return content_.all.low + std::clamp(share, 0.0, 1.0) * content_.all.extent();
}

// How high the bar is there, of the plot's height; 0 where nothing was counted.
double StretchPlot::shareAt(int x) const
{
    const auto& counts = content_.counts;
    const double value = valueAt(x);
    const double extent = content_.counted.extent();
    if (value < content_.counted.low || value > content_.counted.high) {
        return 0.0;
    }
    const double place = extent > 0.0 ? (value - content_.counted.low) / extent : 0.0;
    const std::size_t bin = std::min(
        counts.size() - 1, static_cast<std::size_t>(place * static_cast<double>(counts.size())));
    const double mean =
        static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0})) /
        static_cast<double>(counts.size());
    const double top =
        std::min(static_cast<double>(*std::max_element(counts.begin(), counts.end())),
                 kTallestOfMean * mean);
    return top > 0.0 ? std::min(1.0, static_cast<double>(counts[bin]) / top) : 0.0;
}

std::optional<StretchPlot::End> StretchPlot::endAt(int x) const
{
    if (!(content_.all.extent() > 0.0)) {
        return std::nullopt;
    }
    const int to_low = std::abs(x - positionOf(content_.stretched.low));
    const int to_high = std::abs(x - positionOf(content_.stretched.high));
    if (std::min(to_low, to_high) > kReach) {
        return std::nullopt;
    }
    return to_low < to_high ? End::Low : End::High;
}

void StretchPlot::drag(int x)
{
    PlotRange ends = content_.stretched;
    const double least = kLeastShare * content_.all.extent();
    if (*dragged_ == End::Low) {
        ends.low = std::min(valueAt(x), ends.high - least);
    } else {
        ends.high = std::max(valueAt(x), ends.low + least);
    }
    if (isStretchRange(ends.low, ends.high)) {
        Q_EMIT endsDragged(ends.low, ends.high);
    }
}

void StretchPlot::mousePressEvent(QMouseEvent* event)
{
    dragged_ = event->button() == Qt::LeftButton ? endAt(event->pos().x()) : std::nullopt;
    if (dragged_) {
        Q_EMIT dragEnded();
    }
}

void StretchPlot::mouseMoveEvent(QMouseEvent* event)
{
    if (dragged_) {
        drag(event->pos().x());
    } else {
        setCursor(endAt(event->pos().x()) ? Qt::SplitHCursor : Qt::ArrowCursor);
    }
}

void StretchPlot::mouseReleaseEvent(QMouseEvent* /*event*/)
{
    if (dragged_) {
        dragged_.reset();
        Q_EMIT dragEnded();
    }
}

void StretchPlot::paintEvent(QPaintEvent* /*event*/)
{
    QPainter painter(this);
    const QRect area = plot();
    painter.fillRect(area, palette().color(QPalette::Base));
    const bool has_range = content_.all.extent() > 0.0;
    if (!content_.counts.empty() && content_.ramp != nullptr && has_range) {
        const auto colors = sampledRamp(*content_.ramp);
        for (int x = area.left(); x <= area.right(); ++x) {
            const double share = shareAt(x);
            const int height = share > 0.0 ? std::max(1, qRound(share * (area.height() - 2))) : 0;
            const double tinted = content_.tinted.extent();
            const double along = tinted > 0.0 ? (valueAt(x) - content_.tinted.low) / tinted : 0.5;
            const auto i = static_cast<std::size_t>(std::clamp(along, 0.0, 1.0) * 255.0);
            painter.fillRect(x, area.bottom() + 1 - height, 1, height, colorFrom(colors[i]));
        }
    }
    painter.setPen(palette().color(QPalette::Mid));
    painter.drawRect(area.adjusted(-1, -1, 0, 0));
    if (!has_range || !isEnabled()) {
        return;
    }
    const QColor line = palette().color(QPalette::WindowText);
    painter.setRenderHint(QPainter::Antialiasing);
    for (const double end : {content_.stretched.low, content_.stretched.high}) {
        const int x = positionOf(end);
        painter.fillRect(QRectF(x - 0.5, area.top(), 1.5, area.height()), line);
        QPainterPath mark;
        mark.moveTo(x + 0.25, area.bottom() + 1);
        mark.lineTo(x + 0.25 - kMarkHeight * 0.7, area.bottom() + 1 + kMarkHeight);
        mark.lineTo(x + 0.25 + kMarkHeight * 0.7, area.bottom() + 1 + kMarkHeight);
        mark.closeSubpath();
        painter.fillPath(mark, line);
    }
    painter.setPen(palette().color(QPalette::PlaceholderText));
    const QRect below = rect().adjusted(kMargin, area.bottom() + 1 + kMarkHeight, -kMargin, 0);
    painter.drawText(below, Qt::AlignLeft | Qt::AlignBottom, content_.low_text);
    painter.drawText(below, Qt::AlignRight | Qt::AlignBottom, content_.high_text);
}

} // namespace marsview
