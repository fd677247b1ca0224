#include "ui/widgets/plate.h"

#include <QPainterPath>
#include <QPen>

namespace marsview {
namespace {

constexpr double kCornerRadius = 6.0;
constexpr double kHalo = 2.0; // of the dark line around a bright one, both sides together

} // namespace

QColor plateColor()
{
    return {13, 16, 23, 192};
}

QColor overlayTextColor()
{
    return {240, 242, 246};
}

QColor overlayFaintColor()
{
    return {255, 255, 255, 90};
}

QColor overlayFocusColor()
{
    return {122, 178, 255};
}

void drawText(QPainter& painter, const QRectF& place, Qt::Alignment alignment, const QString& text)
{
    painter.save();
    painter.setPen(overlayTextColor());
    painter.setLayoutDirection(text.isRightToLeft() ? Qt::RightToLeft : Qt::LeftToRight);
    painter.drawText(place, static_cast<int>(alignment | Qt::AlignAbsolute), text);
    painter.restore();
}

void drawPlate(QPainter& painter, const QRectF& rectangle)
{
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(plateColor());
    painter.drawRoundedRect(rectangle, kCornerRadius, kCornerRadius);
    painter.restore();
}

void drawFocus(QPainter& painter, const QRectF& rectangle)
{
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(overlayFocusColor(), 2.0));
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(rectangle.adjusted(1.0, 1.0, -1.0, -1.0), kCornerRadius - 1.0,
                            kCornerRadius - 1.0);
    painter.restore();
}

void drawContrasting(QPainter& painter, const QPainterPath& path, const QColor& color, double width)
{
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(
        QPen(QColor(0, 0, 0, 170), width + kHalo, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPath(path);
    painter.setPen(QPen(color, width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPath(path);
    painter.restore();
}

} // namespace marsview
