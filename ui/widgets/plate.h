// What all overlays have in common: a dark translucent plate and bright text on it.
//
// The map under them can have any color and is dark or bright whatever the palette, so overlays do
// not take their colors from it. White text on the plate keeps a contrast of at least 7 to 1 over
// white and more over everything else.
#pragma once

#include <QColor>
#include <QPainter>
#include <QRectF>

class QPainterPath;

namespace marsview {

/// Between a plate's edge and its contents, in pixels.
constexpr int kPlatePadding = 7;

QColor plateColor();
QColor overlayTextColor();
/// For details less important than the text: rims, tick marks, the empty part of a bar.
QColor overlayFaintColor();
/// For the element with keyboard focus.
QColor overlayFocusColor();

/// Text in the direction in which it reads itself: "−5 km" stays in that order in a layout from
/// right to left. The alignment is meant as it is seen.
void drawText(QPainter& painter, const QRectF& place, Qt::Alignment alignment, const QString& text);

void drawPlate(QPainter& painter, const QRectF& rectangle);
/// Draws the focus rim, inside the rectangle.
void drawFocus(QPainter& painter, const QRectF& rectangle);
/// A bright line with a dark one around it: seen on any color.
void drawContrasting(QPainter& painter,
                     const QPainterPath& path,
                     const QColor& color,
                     double width);

} // namespace marsview
