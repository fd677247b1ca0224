#include "ui/dialogs/stretch_plot.h"

#include "core/view/color_stretch.h"
#include "ui/text/ramp_text.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>

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
    setAccessibleName(tr("Histogram of elevations"));
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
    return rect().adjusted(kMargin, 2, -kMargin, -kMarkHeight - 2);
}

int StretchPlot::positionOf(double height_m) const
{
    const QRect area = plot();
    const double extent = content_.all.maximum_m - content_.all.minimum_m;
    const double share = extent > 0.0 ? (height_m - content_.all.minimum_m) / extent : 0.5;
    return area.left() +
           static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * (area.width() - 1)));
}

double StretchPlot::heightAt(int x) const
{
    const QRect area = plot();
    const double share = static_cast<double>(x - area.left()) / std::max(1, area.width() - 1);
    return content_.all.minimum_m +
           std::clamp(share, 0.0, 1.0) * (content_.all.maximum_m - content_.all.minimum_m);
}

std::optional<StretchPlot::End> StretchPlot::endAt(int x) const
{
    if (!(content_.all.maximum_m > content_.all.minimum_m)) {
        return std::nullopt;
    }
    const int to_low = std::abs(x - positionOf(content_.stretched.minimum_m));
    const int to_high = std::abs(x - positionOf(content_.stretched.maximum_m));
    if (std::min(to_low, to_high) > kReach) {
        return std::nullopt;
    }
    return to_low < to_high ? End::Low : End::High;
}

void StretchPlot::drag(int x)
{
    double low_m = content_.stretched.minimum_m;
    double high_m = content_.stretched.maximum_m;
    const double least_m = kLeastShare * (content_.all.maximum_m - content_.all.minimum_m);
    if (*dragged_ == End::Low) {
        low_m = std::min(heightAt(x), high_m - least_m);
    } else {
        high_m = std::max(heightAt(x), low_m + least_m);
    }
    if (isStretchRange(low_m, high_m)) {
        Q_EMIT endsDragged(low_m, high_m);
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
    const bool has_range = content_.all.maximum_m > content_.all.minimum_m;
    if (content_.histogram && !content_.histogram->counts.empty() && content_.ramp != nullptr &&
        has_range) {
        const auto& counts = content_.histogram->counts;
        const double mean = static_cast<double>(content_.histogram->sample_count) /
                            static_cast<double>(counts.size());
        const double top =
            std::min(static_cast<double>(*std::max_element(counts.begin(), counts.end())),
                     kTallestOfMean * mean);
        const auto colors = sampledRamp(*content_.ramp);
        const HeightRange tinted = tintedRange(*content_.ramp, content_.stretched);
        const double tinted_m = tinted.maximum_m - tinted.minimum_m;
        for (int x = area.left(); x <= area.right() && top > 0.0; ++x) {
            const auto bin = std::min(counts.size() - 1,
                                      static_cast<std::size_t>(x - area.left()) * counts.size() /
                                          static_cast<std::size_t>(area.width()));
            const double share = std::min(1.0, static_cast<double>(counts[bin]) / top);
            const int height =
                counts[bin] == 0 ? 0 : std::max(1, qRound(share * (area.height() - 2)));
            const double along = tinted_m > 0.0 ? (heightAt(x) - tinted.minimum_m) / tinted_m : 0.5;
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
    for (const double end_m : {content_.stretched.minimum_m, content_.stretched.maximum_m}) {
        const int x = positionOf(end_m);
        painter.fillRect(QRectF(x - 0.5, area.top(), 1.5, area.height()), line);
        QPainterPath mark;
        mark.moveTo(x + 0.25, area.bottom() + 1);
        mark.lineTo(x + 0.25 - kMarkHeight * 0.7, area.bottom() + 1 + kMarkHeight);
        mark.lineTo(x + 0.25 + kMarkHeight * 0.7, area.bottom() + 1 + kMarkHeight);
        mark.closeSubpath();
        painter.fillPath(mark, line);
    }
}

} // namespace marsview
