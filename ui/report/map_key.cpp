// Legend, scale bar and north arrow of a report, as SVG.

#include "ui/report/report.h"

#include <QCoreApplication>

#include <algorithm>

namespace marsview {
namespace {

constexpr double kLegendWidth = 430.0;
constexpr double kRampTop = 26.0;
constexpr double kRampHeight = 14.0;
constexpr double kScaleLeft = 510.0;
constexpr double kScaleTop = 40.0;
constexpr double kNorthX = 958.0;
constexpr double kNorthY = 40.0;
constexpr double kNorthRadius = 32.0;

QString
svgText(double x, double y, const QString& text, const char* anchor = "start", int size = 15)
{
    return QStringLiteral(
               "<text x=\"%1\" y=\"%2\" font-size=\"%3\" text-anchor=\"%4\" "
               "fill=\"#222222\">%5</text>\n")
        .arg(x)
        .arg(y)
        .arg(size)
        .arg(QLatin1String(anchor), text.toHtmlEscaped());
}

QString svgLine(double x1, double y1, double x2, double y2, double width = 1.2)
{
    return QStringLiteral(
               "<line x1=\"%1\" y1=\"%2\" x2=\"%3\" y2=\"%4\" stroke=\"#222222\" "
               "stroke-width=\"%5\"/>\n")
        .arg(x1)
        .arg(y1)
        .arg(x2)
        .arg(y2)
        .arg(width);
}

QString legendSvg(const ReportLegend& legend)
{
    QString svg;
    if (!legend.colors.isEmpty()) {
        svg += QStringLiteral(
            "<defs><linearGradient id=\"ramp\" x1=\"0\" y1=\"0\" x2=\"1\" y2=\"0\">");
        const qsizetype last = std::max<qsizetype>(1, legend.colors.size() - 1);
        for (qsizetype i = 0; i < legend.colors.size(); ++i) {
            svg += QStringLiteral("<stop offset=\"%1\" stop-color=\"%2\"/>")
                       .arg(static_cast<double>(i) / static_cast<double>(last))
                       .arg(legend.colors[i].name());
        }
        svg += QStringLiteral("</linearGradient></defs>\n");
        svg += svgText(0.0, 16.0, legend.title);
        svg += QStringLiteral(
                   "<rect x=\"0.5\" y=\"%1\" width=\"%2\" height=\"%3\" "
                   "fill=\"url(#ramp)\" stroke=\"#222222\" stroke-width=\"0.8\"/>\n")
                   .arg(kRampTop)
                   .arg(kLegendWidth)
                   .arg(kRampHeight);
        for (const ReportLegend::Tick& tick : legend.ticks) {
            const double x = 0.5 + kLegendWidth * tick.share;
            svg += svgLine(x, kRampTop + kRampHeight, x, kRampTop + kRampHeight + 5.0, 1.0);
            // Texts at the ends stay within the strip.
            const char* anchor = tick.share < 0.04 ? "start" : tick.share > 0.96 ? "end" : "middle";
            svg += svgText(x, kRampTop + kRampHeight + 19.0, tick.text, anchor, 13);
        }
    }
    if (!legend.contours.isEmpty()) {
        svg += svgText(0.0, legend.colors.isEmpty() ? 16.0 : 79.0, legend.contours, "start", 13);
    }
    return svg;
}

QString scaleSvg(const ReportScale& scale)
{
    const double right = kScaleLeft + 1000.0 * scale.share;
    QString svg = svgText((kScaleLeft + right) / 2.0, kScaleTop - 9.0, scale.text, "middle");
    svg += svgLine(kScaleLeft, kScaleTop, right, kScaleTop, 2.0);
    svg += svgLine(kScaleLeft, kScaleTop - 6.0, kScaleLeft, kScaleTop + 6.0, 2.0);
    svg += svgLine(right, kScaleTop - 6.0, right, kScaleTop + 6.0, 2.0);
    svg +=
        svgText(kScaleLeft, kScaleTop + 22.0,
                QCoreApplication::translate("Report", "in the middle of the picture"), "start", 12);
    return svg;
}

QString northSvg(double north_deg)
{
    return QStringLiteral(
               "<g transform=\"translate(%1 %2) rotate(%3)\">"
               "<circle r=\"%4\" fill=\"none\" stroke=\"#222222\" stroke-width=\"1\"/>"
               "<path d=\"M0 -26 L9 12 L0 6 Z\" fill=\"#222222\"/>"
               "<path d=\"M0 -26 L-9 12 L0 6 Z\" fill=\"none\" stroke=\"#222222\" "
               "stroke-width=\"1\"/>"
               "<text x=\"0\" y=\"27\" font-size=\"13\" text-anchor=\"middle\" "
               "fill=\"#222222\">%5</text></g>\n")
        .arg(kNorthX)
        .arg(kNorthY)
        .arg(north_deg)
        .arg(kNorthRadius)
        //: On a north arrow: north
        .arg(QCoreApplication::translate("Report", "N").toHtmlEscaped());
}

} // namespace

QByteArray mapKeySvg(const ReportMap& map)
{
    QString svg = QStringLiteral(
                      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1000 %1\" "
                      "font-family=\"sans-serif\">\n")
                      .arg(kMapKeyHeight);
    if (map.legend) {
        svg += legendSvg(*map.legend);
    }
    if (map.scale) {
        svg += scaleSvg(*map.scale);
    }
    svg += northSvg(map.north_deg);
    return (svg + QStringLiteral("</svg>\n")).toUtf8();
}

} // namespace marsview
