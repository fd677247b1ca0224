#include "ui/panels/time_plot.h"

#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

constexpr int kDecades = 4; // from 1 µs on

// 0 at the bottom, 1 at the top.
double heightOf(std::chrono::nanoseconds span)
{
    const double us = std::max(1.0, static_cast<double>(span.count()) / 1e3);
    return std::min(1.0, std::log10(us) / kDecades);
}

} // namespace

TimePlot::TimePlot(QWidget* parent)
    : QWidget(parent)
{
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void TimePlot::add(const Moment& moment)
{
    moments_.push_back(moment);
    if (moments_.size() > kMomentsMax) {
        moments_.pop_front();
    }
    update();
}

void TimePlot::clear()
{
    moments_.clear();
    update();
}

QSize TimePlot::sizeHint() const
{
    return {160, fontMetrics().height() * 2};
}

void TimePlot::paintEvent(QPaintEvent* /*event*/)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF frame = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5);
    QPainterPath outline;
    outline.addRoundedRect(frame, 3.0, 3.0);
    painter.fillPath(outline, palette().color(QPalette::Base));
    painter.setClipPath(outline);
    QColor faint = palette().color(QPalette::Text);
    faint.setAlpha(38);
    painter.setPen(QPen(faint, 1.0));
    for (int decade = 1; decade < kDecades; ++decade) {
        const double y = std::round(frame.bottom() - frame.height() * decade / kDecades) + 0.5;
        painter.drawLine(QPointF(frame.left(), y), QPointF(frame.right(), y));
    }
    const auto draw = [&](std::chrono::nanoseconds Moment::*span, const QColor& color) {
        QPolygonF line;
        const double step = frame.width() / static_cast<double>(kMomentsMax - 1);
        for (std::size_t i = 0; i < moments_.size(); ++i) {
            const double back = step * static_cast<double>(moments_.size() - 1 - i);
            const double x = isRightToLeft() ? frame.left() + back : frame.right() - back;
            const double room = frame.height() - 4.0;
            line.append({x, frame.bottom() - 2.0 - room * heightOf(moments_[i].*span)});
        }
        painter.setPen(QPen(color, 1.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
        painter.drawPolyline(line);
    };
    QColor longest = palette().color(QPalette::Text);
    longest.setAlpha(120);
    draw(&Moment::longest, longest);
    draw(&Moment::usual, palette().color(QPalette::Highlight));
    painter.setClipping(false);
    painter.setPen(QPen(faint, 1.0));
    painter.drawPath(outline);
}

} // namespace marsview
