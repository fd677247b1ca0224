// Text with a dark rim, which can be read over any color: labels over a map.
#pragma once

#include <QFont>
#include <QImage>
#include <QPointF>
#include <QSizeF>
#include <QString>

class QPainter;

namespace marsview {

/// Points around letters and dots, half of them visible.
inline constexpr double kLabelRim = 3.0;
inline constexpr double kLabelDotRadius = 2.5;

enum class LabelFont { Small, Large };

/// The font of a label in a widget with this font.
QFont labelFont(const QFont& font, LabelFont size);
/// In points, the rim included.
QSizeF labelSize(const QString& text, const QFont& letters);
/// White letters; `scale` pixels per point.
QImage labelPicture(const QString& text, const QFont& letters, double scale);
/// Marks the place next to a label.
void drawLabelDot(QPainter& painter, QPointF place);

} // namespace marsview
