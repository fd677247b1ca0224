#include "ui/widgets/rimmed_label.h"

#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>
#include <QPen>

#include <cmath>

namespace marsview {
namespace {

constexpr double kLargeFont = 1.25;
const QColor kRimColor(0, 0, 0, 200);

} // namespace

QFont labelFont(const QFont& font, LabelFont size)
{
    QFont result = font;
    result.setWeight(QFont::DemiBold);
    if (size == LabelFont::Large) {
        result.setPointSizeF(result.pointSizeF() * kLargeFont);
    }
    return result;
}

QSizeF labelSize(const QString& text, const QFont& letters)
{
    const QFontMetricsF metrics(letters);
    return {std::ceil(metrics.horizontalAdvance(text) + 2.0 * kLabelRim),
            std::ceil(metrics.height() + kLabelRim)};
}

QImage labelPicture(const QString& text, const QFont& letters, double scale)
{
    QImage image((labelSize(text, letters) * scale).toSize(), QImage::Format_ARGB32_Premultiplied);
    image.fill(Qt::transparent);
    QPainterPath path;
    path.addText(kLabelRim, 0.5 * kLabelRim + QFontMetricsF(letters).ascent(), letters, text);
    QPainter painter(&image);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.scale(scale, scale);
    painter.strokePath(path,
                       QPen(kRimColor, kLabelRim, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.fillPath(path, Qt::white);
    return image;
}

void drawLabelDot(QPainter& painter, QPointF place)
{
    QPainterPath dot;
    dot.addEllipse(place, kLabelDotRadius, kLabelDotRadius);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.strokePath(dot, QPen(kRimColor, kLabelRim));
    painter.fillPath(dot, Qt::white);
}

} // namespace marsview
