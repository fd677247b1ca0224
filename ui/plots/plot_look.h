// What diagrams have in common: their colors, and their pictures.
#pragma once

#include "ui/plots/custom_plot.h"

#include <QPalette>
#include <QString>

#include <initializer_list>

namespace marsview {

/// The color of texts, as it is and in two fainter shades for lines.
struct PlotInk {
    QColor text;
    QColor faint;
    QColor fainter;
};
PlotInk plotInk(const QPalette& colors);

/// Sets background, axes and grid of a diagram.
void paintAxes(QCustomPlot& plot,
               std::initializer_list<QCPAxis*> axes,
               const QPalette& colors,
               const QFont& font);
/// Sets the text at the cursor, which lies over the curves.
void paintCursorText(QCPItemText& text, const QPalette& colors, const QFont& font);

/// The file is SVG, PDF or, with `scale` pixels for each of `size`, PNG, by its extension. `title`
/// is that of an SVG file.
bool savePlot(
    QCustomPlot& plot, const QString& path, QSize size, double scale, const QString& title);

} // namespace marsview
