#include "ui/plots/plot_look.h"

#include <QFileInfo>
#include <QSvgGenerator>

namespace marsview {

PlotInk plotInk(const QPalette& colors)
{
    PlotInk ink;
    ink.text = ink.faint = ink.fainter = colors.color(QPalette::Text);
    ink.faint.setAlpha(60);
    ink.fainter.setAlpha(26);
    return ink;
}

void paintAxes(QCustomPlot& plot,
               std::initializer_list<QCPAxis*> axes,
               const QPalette& colors,
               const QFont& font)
{
    const PlotInk ink = plotInk(colors);
    plot.setBackground(colors.color(QPalette::Base));
    for (QCPAxis* axis : axes) {
        axis->setBasePen(QPen(ink.faint));
        axis->setTickPen(QPen(ink.faint));
        axis->setSubTickPen(QPen(ink.fainter));
        axis->setTickLabelColor(ink.text);
        axis->setLabelColor(ink.text);
        axis->setTickLabelFont(font);
        axis->setLabelFont(font);
        axis->grid()->setPen(QPen(ink.fainter));
        axis->grid()->setZeroLinePen(QPen(ink.fainter));
    }
}

void paintCursorText(QCPItemText& text, const QPalette& colors, const QFont& font)
{
    text.setColor(colors.color(QPalette::Text));
    text.setFont(font);
    QColor plate = colors.color(QPalette::Base);
    plate.setAlpha(220);
    text.setBrush(plate);
}

bool savePlot(
    QCustomPlot& plot, const QString& path, QSize size, double scale, const QString& title)
{
    const QString suffix = QFileInfo(path).suffix().toLower();
    if (suffix == QStringLiteral("svg")) {
        QSvgGenerator file;
        file.setFileName(path);
        file.setSize(size);
        file.setViewBox(QRect(QPoint(0, 0), size));
        file.setTitle(title);
        QCPPainter painter;
        if (!painter.begin(&file)) {
            return false;
        }
        plot.toPainter(&painter, size.width(), size.height());
        return painter.end();
    }
    if (suffix == QStringLiteral("pdf")) {
        return plot.savePdf(path, size.width(), size.height());
    }
    return plot.savePng(path, size.width(), size.height(), scale);
}

} // namespace marsview
