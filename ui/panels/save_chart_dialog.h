// Asking where to save the numbers or the drawing of a chart.
#pragma once

#include <QString>

#include <functional>

class QWidget;

namespace marsview {

struct ChartFile {
    QString title;  // of the dialog
    QString name;   // offered, without ending
    QString folder; // offered
};

/// Opens a file dialog over `parent` for a table or a picture (csv, png, svg, pdf). `save` gets the
/// chosen path and returns whether the file was written; a message says so if not. Returns at once.
void askChartFile(QWidget& parent,
                  const ChartFile& file,
                  const std::function<bool(const QString& path)>& save);

} // namespace marsview
