#include "ui/overlay/hand_pointer.h"

#include "ui/render/cursor_renderer.h"

#include <QPainter>
#include <QPainterPath>
#include <QPen>

#include <cmath>

namespace marsview {
namespace {

constexpr int kSide = 40; // of the widget, odd halves of a point included

// Dark around white around red: one of the two stands out on any ground, and the red on both.
constexpr double kWhiteRim = 2.0;
constexpr double kDarkRim = 1.5;

QColor cursorColor()
{
    return QColor::fromRgbF(kCursorRed, kCursorGreen, kCursorBlue);
}

} // namespace

HandPointer::HandPointer(QWidget* parent)
    : QWidget(parent)
{
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    setAccessibleDescription(tr("The arrow points to the stylus"));
    resize(kSide, kSide);
    hide();
}

void HandPointer::pointTo(QPointF middle, QPointF direction)
{
    const QPoint corner(static_cast<int>(std::lround(middle.x() - kSide / 2.0)),
                        static_cast<int>(std::lround(middle.y() - kSide / 2.0)));
    const QPointF offset = middle - (QPointF(corner) + QPointF(kSide, kSide) / 2.0);
    if (offset != offset_ || direction != direction_) {
        offset_ = offset;
        direction_ = direction;
        update();
    }
    move(corner);
    const QString spoken = spokenText();
    if (spoken != accessibleName()) {
        setAccessibleName(spoken);
    }
    if (isHidden()) {
        show();
        raise();
    }
}

QString HandPointer::spokenText() const
{
    if (std::abs(direction_.x()) > std::abs(direction_.y())) {
        return direction_.x() > 0.0 ? tr("The stylus is to the right of the picture")
                                    : tr("The stylus is to the left of the picture");
    }
    return direction_.y() > 0.0 ? tr("The stylus is below the picture")
                                : tr("The stylus is above the picture");
}

void HandPointer::paintEvent(QPaintEvent* /*event*/)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.translate(QPointF(kSide, kSide) / 2.0 + offset_);
    painter.rotate(qRadiansToDegrees(std::atan2(direction_.y(), direction_.x())));
    QPainterPath arrow;
    arrow.moveTo(13.0, 0.0);
    arrow.lineTo(-9.0, 10.0);
    arrow.lineTo(-4.0, 0.0);
    arrow.lineTo(-9.0, -10.0);
    arrow.closeSubpath();
    const auto draw = [&](const QColor& color, double rim) {
        painter.setPen(rim > 0.0
                           ? QPen(color, 2.0 * rim, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin)
                           : QPen(Qt::NoPen));
        painter.setBrush(color);
        painter.drawPath(arrow);
    };
    draw(QColor(0, 0, 0, 200), kWhiteRim + kDarkRim);
    draw(Qt::white, kWhiteRim);
    draw(cursorColor(), 0.0);
}

} // namespace marsview
