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
/// chosen path. Returns at once.
void askChartFile(QWidget& parent,
                  const ChartFile& file,
                  const std::function<void(const QString& path)>& save);
/// Why nothing was saved, if writing `path` failed.
QString notWrittenText(const QString& path);

} // namespace marsview
