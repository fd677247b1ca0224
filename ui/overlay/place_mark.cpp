#include "ui/overlay/place_mark.h"

#include <QPainter>
#include <QPainterPath>
#include <QPen>

#include <cmath>
#include <numbers>

namespace marsview {
namespace {

constexpr int kWidth = 30;
constexpr int kHeight = 42;
constexpr QPointF kTip(kWidth / 2.0, kHeight - 3.0);
constexpr double kRadius = 10.5;    // of the head
constexpr double kHeadAbove = 24.5; // of its middle above the tip

// Unlike the red stylus and the warm ramps; a white and a dark rim set it off from cool ones.
QColor markColor()
{
    return {27, 108, 229};
}

QPainterPath outline()
{
    const QPointF head(0.0, -kHeadAbove);
    // The sides of the point touch the head.
    const double half = std::acos(kRadius / kHeadAbove);
    const double degrees = 90.0 - half * 180.0 / std::numbers::pi;
    QPainterPath path;
    path.moveTo(0.0, 0.0);
    path.arcTo(QRectF(head.x() - kRadius, head.y() - kRadius, 2.0 * kRadius, 2.0 * kRadius),
               -degrees, 180.0 + 2.0 * degrees);
    path.closeSubpath();
    return path;
}

} // namespace

PlaceMark::PlaceMark(QWidget* parent)
    : QWidget(parent)
{
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    setAccessibleName(tr("Marked place"));
    resize(kWidth, kHeight);
    hide();
}

void PlaceMark::pointAt(QPointF place)
{
    const QPointF corner = place - kTip;
    const QPoint whole(static_cast<int>(std::floor(corner.x())),
                       static_cast<int>(std::floor(corner.y())));
    const QPointF offset = corner - QPointF(whole);
    if (offset != offset_) {
        offset_ = offset;
        update();
    }
    move(whole);
    show();
}

QPointF PlaceMark::tip() const
{
    return QPointF(pos()) + kTip + offset_;
}

void PlaceMark::paintEvent(QPaintEvent* /*event*/)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.translate(kTip + offset_);
    const QPainterPath pin = outline();
    painter.strokePath(pin,
                       QPen(QColor(0, 0, 0, 190), 4.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.strokePath(pin, QPen(Qt::white, 2.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.fillPath(pin, markColor());
    painter.setPen(Qt::NoPen);
    painter.setBrush(Qt::white);
    painter.drawEllipse(QPointF(0.0, -kHeadAbove), kRadius * 0.4, kRadius * 0.4);
}

} // namespace marsview
