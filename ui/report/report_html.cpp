#include "ui/report/report.h"

#include <QBuffer>
#include <QCoreApplication>
#include <QLocale>

namespace marsview {
namespace {

constexpr int kMapJpegQuality = 92;

// One column that also prints well. No script, no other file.
constexpr const char* kStyleSheet = R"(
:root { color: #1d1d1f; background: #f4f4f2; }
body { font: 15px/1.5 system-ui, "Noto Sans", "DejaVu Sans", sans-serif; margin: 0; }
main { max-width: 960px; margin: 24px auto; padding: 40px 48px; background: #ffffff;
  box-shadow: 0 1px 4px rgba(0, 0, 0, 0.18); }
header { border-bottom: 2px solid #b03a1e; padding-bottom: 12px; margin-bottom: 20px; }
h1, h2, p, td, dd { overflow-wrap: anywhere; }
h1 { font-size: 28px; line-height: 1.2; margin: 0; font-weight: 600; }
h2 { font-size: 19px; margin: 36px 0 8px; font-weight: 600; }
.subtitle { color: #5b5b60; margin: 4px 0 0; }
.note { color: #5b5b60; margin: 4px 0 10px; }
figure { margin: 0 0 12px; }
figure img, figure svg { display: block; width: 100%; height: auto; }
.map img { border: 1px solid #c9c9c9; box-sizing: border-box; }
.map svg { margin-top: 10px; }
figcaption { color: #5b5b60; font-size: 13px; margin-top: 4px; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th { text-align: start; font-weight: 600; border-bottom: 1.5px solid #1d1d1f; }
td { border-bottom: 1px solid #e2e2e2; vertical-align: top; }
th, td { padding: 4px 12px 4px 0; }
.facts { columns: 2; column-gap: 40px; margin: 8px 0 16px; }
.facts div { display: flex; justify-content: space-between; gap: 16px; break-inside: avoid;
  border-bottom: 1px solid #e2e2e2; padding: 3px 0; }
.facts dt { color: #5b5b60; }
.facts dd { margin: 0; text-align: end; font-variant-numeric: tabular-nums; }
footer { margin-top: 40px; padding-top: 10px; border-top: 1px solid #c9c9c9; color: #5b5b60;
  font-size: 13px; }
footer p { margin: 2px 0; }
.drawing { max-width: 720px; }
.square { max-width: 420px; }
@media (max-width: 640px) { main { padding: 20px; margin: 0; } .facts { columns: 1; } }
@media print { :root { background: none; } main { box-shadow: none; margin: 0; padding: 0;
  max-width: none; } section { break-inside: avoid; } h2 { break-after: avoid; } }
)";

QString escaped(const QString& text)
{
    return text.toHtmlEscaped();
}

QString dataAddress(const QByteArray& bytes, const char* type)
{
    return QStringLiteral("data:%1;base64,%2")
        .arg(QLatin1String(type), QLatin1String(bytes.toBase64()));
}

QString mapHtml(const ReportMap& map)
{
    QByteArray jpeg;
    QBuffer buffer(&jpeg);
    map.picture.save(&buffer, "JPEG", kMapJpegQuality);
    return QStringLiteral(
               "<figure class=\"map\">\n<img alt=\"%1\" width=\"%2\" height=\"%3\" "
               "src=\"%4\">\n%5<figcaption>%1</figcaption>\n</figure>\n")
        .arg(escaped(map.caption), QString::number(map.picture.width()),
             QString::number(map.picture.height()), dataAddress(jpeg, "image/jpeg"),
             QString::fromUtf8(mapKeySvg(map)));
}

QString factsHtml(const QList<ReportFact>& facts)
{
    QString html = QStringLiteral("<dl class=\"facts\">\n");
    for (const ReportFact& fact : facts) {
        html += QStringLiteral("<div><dt>%1</dt><dd>%2</dd></div>\n")
                    .arg(escaped(fact.label), escaped(fact.value));
    }
    return html + QStringLiteral("</dl>\n");
}

QString tableHtml(const ReportTable& table)
{
    QString html = QStringLiteral("<table>\n<thead><tr>");
    for (const QString& title : table.header) {
        html += QStringLiteral("<th scope=\"col\">%1</th>").arg(escaped(title));
    }
    html += QStringLiteral("</tr></thead>\n<tbody>\n");
    for (const QStringList& row : table.rows) {
        html += QStringLiteral("<tr>");
        for (const QString& cell : row) {
            html += QStringLiteral("<td>%1</td>").arg(escaped(cell));
        }
        html += QStringLiteral("</tr>\n");
    }
    return html + QStringLiteral("</tbody>\n</table>\n");
}

QString sectionHtml(const ReportSection& section)
{
    QString html = QStringLiteral("<section>\n<h2>%1</h2>\n").arg(escaped(section.title));
    if (!section.note.isEmpty()) {
        html += QStringLiteral("<p class=\"note\">%1</p>\n").arg(escaped(section.note));
    }
    if (!section.facts.isEmpty()) {
        html += factsHtml(section.facts);
    }
    for (const ReportFigure& figure : section.figures) {
        const bool is_square = figure.size.width() < 1.3 * figure.size.height();
        html += QStringLiteral(
                    "<figure class=\"%1\"><img alt=\"%2\" src=\"%3\">"
                    "<figcaption>%2</figcaption></figure>\n")
                    .arg(is_square ? QStringLiteral("square") : QStringLiteral("drawing"),
                         escaped(figure.caption), dataAddress(figure.svg, "image/svg+xml"));
    }
    if (section.table) {
        html += tableHtml(*section.table);
    }
    return html + QStringLiteral("</section>\n");
}

} // namespace

QString reportHtml(const Report& report)
{
    const QLocale locale;
    QString html = QStringLiteral(
                       "<!DOCTYPE html>\n<html lang=\"%1\" dir=\"%2\">\n<head>\n"
                       "<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                       "<title>%3</title>\n<style>%4</style>\n</head>\n<body>\n<main>\n")
                       .arg(locale.bcp47Name(),
                            locale.textDirection() == Qt::RightToLeft ? QStringLiteral("rtl")
                                                                      : QStringLiteral("ltr"),
                            escaped(report.title), QLatin1String(kStyleSheet));
    html += QStringLiteral("<header>\n<h1>%1</h1>\n<p class=\"subtitle\">%2</p>\n</header>\n")
                .arg(escaped(report.title), escaped(report.subtitle));
    html += mapHtml(report.map);
    for (const ReportSection& section : report.sections) {
        html += sectionHtml(section);
    }
    html += QStringLiteral("<footer>\n");
    for (const QString& line : {report.credit, report.made_by}) {
        if (!line.isEmpty()) {
            html += QStringLiteral("<p>%1</p>\n").arg(escaped(line));
        }
    }
    return html + QStringLiteral("</footer>\n</main>\n</body>\n</html>\n");
}

} // namespace marsview
