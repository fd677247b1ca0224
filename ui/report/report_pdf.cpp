#include "ui/report/report_pdf.h"

#include <QBuffer>
#include <QCoreApplication>
#include <QFont>
#include <QFontMetricsF>
#include <QGuiApplication>
#include <QPageLayout>
#include <QPainter>
#include <QPdfWriter>
#include <QSaveFile>
#include <QSvgRenderer>
#include <QTextDocument>
#include <QTextOption>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace marsview {
namespace {

constexpr int kDotsPerInch = 300;
constexpr double kMarginMm = 18.0;
constexpr double kTitlePoints = 20.0;
constexpr double kHeadingPoints = 13.0;
constexpr double kTextPoints = 9.5;
constexpr double kSmallPoints = 8.0;
const QColor kInk(29, 29, 31);
const QColor kFaint(91, 91, 96);
const QColor kRule(214, 214, 214);
const QColor kAccent(176, 58, 30);

constexpr double dots(double mm)
{
    return mm / 25.4 * kDotsPerInch;
}

constexpr double kFactGap = dots(8.0); // between the columns of facts

// ReportPages from top to bottom. Lengths are dots.
class ReportPages {
public:
    // `page_count` of an earlier run, for the page numbers; 0: unknown.
    ReportPages(QPdfWriter& writer, const Report& report, int page_count)
        : writer_(writer)
        , report_(report)
        , page_count_(page_count)
        , painter_(&writer)
        , width_(writer.width())
        , height_(writer.height() - dots(9.0)) // without the footer
    {}

    bool isActive() const { return painter_.isActive(); }
    int pageCount() const { return page_; }

    void write()
    {
        writeTitle();
        writeMap();
        for (const ReportSection& section : report_.sections) {
            writeSection(section);
        }
        if (!report_.credit.isEmpty()) {
            y_ += dots(5.0);
            paragraph(report_.credit, kSmallPoints, kFaint);
        }
        footer();
        painter_.end();
    }

private:
    QFont font(double points, QFont::Weight weight = QFont::Normal) const
    {
        QFont font = QGuiApplication::font();
        font.setPointSizeF(points);
        font.setWeight(weight);
        return font;
    }
    QFontMetricsF metrics(const QFont& font) const { return QFontMetricsF(font, &writer_); }

    void footer()
    {
        painter_.setFont(font(kSmallPoints));
        painter_.setPen(kFaint);
        const QRectF line(0.0, writer_.height() - dots(5.0), width_, dots(5.0));
        painter_.drawText(line, Qt::AlignLeft | Qt::AlignBottom, report_.made_by);
        //: Page number: %1 of %2
        painter_.drawText(line, Qt::AlignRight | Qt::AlignBottom,
                          QCoreApplication::translate("Report", "Page %1 of %2")
                              .arg(page_)
                              .arg(std::max(page_, page_count_)));
    }

    void nextPage()
    {
        footer();
        writer_.newPage();
        ++page_;
        y_ = 0.0;
    }

    void ensure(double height)
    {
        if (y_ > 0.0 && y_ + height > height_) {
            nextPage();
        }
    }

    // Long names, such as those of files, break anywhere.
    static QTextOption wrapped(Qt::Alignment alignment = Qt::AlignLeft)
    {
        QTextOption option(alignment);
        option.setWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere);
        return option;
    }

    double heightOf(const QString& text, const QFont& font, double width) const
    {
        painter_.setFont(font);
        const QRectF box = painter_.boundingRect(QRectF(0.0, 0.0, width, 1e6), text, wrapped());
        return std::max(box.height(), metrics(font).height());
    }

    void paragraph(const QString& text,
                   double points,
                   const QColor& color,
                   QFont::Weight weight = QFont::Normal)
    {
        const QFont used = font(points, weight);
        const double height = heightOf(text, used, width_);
        ensure(height);
        painter_.setFont(used);
        painter_.setPen(color);
        painter_.drawText(QRectF(0.0, y_, width_, height), text, wrapped());
        y_ += height;
    }

    void rule(double y, const QColor& color, double thickness_mm)
    {
        painter_.setPen(QPen(color, dots(thickness_mm)));
        painter_.drawLine(QPointF(0.0, y), QPointF(width_, y));
    }

    void writeTitle()
    {
        paragraph(report_.title, kTitlePoints, kInk, QFont::DemiBold);
        paragraph(report_.subtitle, kTextPoints, kFaint);
        y_ += dots(2.0);
        rule(y_, kAccent, 0.5);
        y_ += dots(4.0);
    }

    void drawing(const QByteArray& svg, const QRectF& area)
    {
        QSvgRenderer renderer(svg);
        renderer.render(&painter_, area);
    }

    void writeMap()
    {
        const ReportMap& map = report_.map;
        const double key = width_ * kMapKeyHeight / 1000.0;
        double height = width_ * map.picture.height() / std::max(1, map.picture.width());
        const double room = height_ - y_ - key - dots(12.0);
        const double scale = std::min(1.0, room / height);
        height *= scale;
        const double width = width_ * scale;
        const double left = (width_ - width) / 2.0;
        painter_.drawImage(QRectF(left, y_, width, height), map.picture);
        painter_.setPen(QPen(kRule, dots(0.2)));
        painter_.setBrush(Qt::NoBrush);
        painter_.drawRect(QRectF(left, y_, width, height));
        y_ += height + dots(3.0);
        // As wide as the picture, so that the scale bar is right.
        drawing(mapKeySvg(map), QRectF(left, y_, width, key * scale));
        y_ += key * scale + dots(1.0);
        paragraph(map.caption, kSmallPoints, kFaint);
        y_ += dots(4.0);
    }

    void writeSection(const ReportSection& section)
    {
        const QFont heading = font(kHeadingPoints, QFont::DemiBold);
        // A heading is never alone at the bottom of a page, and on that of its figures.
        double below = 0.0;
        for (const ReportFigure& figure : section.figures) {
            below += figureHeight(figure);
        }
        if (below > 0.0) {
            below +=
                factsHeight(section.facts) + dots(5.0) +
                (section.note.isEmpty() ? 0.0 : heightOf(section.note, font(kTextPoints), width_));
        }
        const double top = metrics(heading).height() + dots(5.0);
        ensure(top + (top + below <= height_ ? std::max(below, dots(20.0)) : dots(20.0)));
        y_ += y_ > 0.0 ? dots(4.0) : 0.0;
        paragraph(section.title, kHeadingPoints, kInk, QFont::DemiBold);
        y_ += dots(1.0);
        if (!section.note.isEmpty()) {
            paragraph(section.note, kTextPoints, kFaint);
            y_ += dots(1.0);
        }
        if (!section.facts.isEmpty()) {
            writeFacts(section.facts);
        }
        for (const ReportFigure& figure : section.figures) {
            writeFigure(figure);
        }
        if (section.table) {
            writeTable(*section.table);
        }
    }

    // Of the row of two facts that begins with `first`.
    double factRowHeight(const QList<ReportFact>& facts, qsizetype first) const
    {
        const QFont used = font(kTextPoints);
        double height = metrics(used).height();
        for (qsizetype k = first; k < std::min(first + 2, facts.size()); ++k) {
            const double label = metrics(used).horizontalAdvance(facts[k].label) + dots(3.0);
            height = std::max(height, heightOf(facts[k].value, used, factColumn() - label));
        }
        return height;
    }
    double factsHeight(const QList<ReportFact>& facts) const
    {
        double height = dots(2.0);
        for (qsizetype i = 0; i < facts.size(); i += 2) {
            height += factRowHeight(facts, i) + dots(1.6);
        }
        return height;
    }
    double factColumn() const { return (width_ - kFactGap) / 2.0; }

    // In two columns, row by row.
    void writeFacts(const QList<ReportFact>& facts)
    {
        const QFont used = font(kTextPoints);
        const double column = factColumn();
        for (qsizetype i = 0; i < facts.size(); i += 2) {
            const double height = factRowHeight(facts, i);
            ensure(height + dots(1.6));
            for (qsizetype k = i; k < std::min(i + 2, facts.size()); ++k) {
                const double left = k == i ? 0.0 : column + kFactGap;
                const double label = metrics(used).horizontalAdvance(facts[k].label) + dots(3.0);
                painter_.setFont(used);
                painter_.setPen(kFaint);
                painter_.drawText(QRectF(left, y_, column, height), Qt::AlignLeft, facts[k].label);
                painter_.setPen(kInk);
                painter_.drawText(QRectF(left + label, y_, column - label, height), facts[k].value,
                                  wrapped(Qt::AlignRight));
                painter_.setPen(QPen(kRule, dots(0.15)));
                const double bottom = y_ + height + dots(0.6);
                painter_.drawLine(QPointF(left, bottom), QPointF(left + column, bottom));
            }
            y_ += height + dots(1.6);
        }
        y_ += dots(2.0);
    }

    // Columns as wide as their contents, and the wide ones wrapped where there is no room.
    std::vector<double> columnsOf(const ReportTable& table, const QFont& used) const
    {
        const auto count = static_cast<std::size_t>(table.header.size());
        std::vector<double> widths(count, 0.0);
        double sum = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            const auto column = static_cast<qsizetype>(i);
            widths[i] =
                metrics(font(kTextPoints, QFont::DemiBold)).horizontalAdvance(table.header[column]);
            for (const QStringList& row : table.rows) {
                widths[i] = std::max(widths[i], metrics(used).horizontalAdvance(row[column]));
            }
            widths[i] += dots(4.0);
            sum += widths[i];
        }
        const double fair = width_ / static_cast<double>(count);
        double narrow = 0.0;
        double wide = 0.0;
        for (const double width : widths) {
            (width <= fair ? narrow : wide) += width;
        }
        for (double& width : widths) {
            if (sum <= width_) {
                width *= width_ / sum;
            } else if (width > fair) {
                width *= (width_ - narrow) / wide;
            }
        }
        return widths;
    }

    double
    rowHeight(const QStringList& row, const std::vector<double>& widths, const QFont& used) const
    {
        double height = metrics(used).height();
        for (std::size_t i = 0; i < widths.size(); ++i) {
            height = std::max(
                height, heightOf(row[static_cast<qsizetype>(i)], used, widths[i] - dots(3.0)));
        }
        return height;
    }

    void tableRow(const QStringList& row,
                  const std::vector<double>& widths,
                  const QFont& used,
                  double height)
    {
        painter_.setFont(used);
        painter_.setPen(kInk);
        double left = 0.0;
        for (std::size_t i = 0; i < widths.size(); ++i) {
            painter_.drawText(QRectF(left, y_, widths[i] - dots(3.0), height),
                              row[static_cast<qsizetype>(i)], wrapped());
            left += widths[i];
        }
        y_ += height + dots(0.8);
    }

    void writeTable(const ReportTable& table)
    {
        const QFont used = font(kTextPoints);
        const QFont bold = font(kTextPoints, QFont::DemiBold);
        const std::vector<double> widths = columnsOf(table, used);
        const double header = rowHeight(table.header, widths, bold);
        const auto write_header = [&] {
            tableRow(table.header, widths, bold, header);
            rule(y_, kInk, 0.3);
            y_ += dots(0.8);
        };
        ensure(3.0 * header);
        write_header();
        for (const QStringList& row : table.rows) {
            const double height = rowHeight(row, widths, used);
            if (y_ + height + dots(1.6) > height_) {
                nextPage();
                write_header();
            }
            tableRow(row, widths, used, height);
            rule(y_, kRule, 0.15);
            y_ += dots(0.8);
        }
        y_ += dots(2.0);
    }

    double figureWidth(const ReportFigure& figure) const
    {
        return figure.size.height() > 0.75 * figure.size.width() ? 0.5 * width_ : width_;
    }
    // With its caption.
    double figureHeight(const ReportFigure& figure) const
    {
        const double caption =
            figure.caption.isEmpty() ? 0.0 : heightOf(figure.caption, font(kSmallPoints), width_);
        return figureWidth(figure) * figure.size.height() / figure.size.width() + caption +
               dots(2.0);
    }

    void writeFigure(const ReportFigure& figure)
    {
        const double width = figureWidth(figure);
        const double height = width * figure.size.height() / figure.size.width();
        ensure(figureHeight(figure));
        drawing(figure.svg, QRectF(0.0, y_, width, height));
        y_ += height;
        if (!figure.caption.isEmpty()) {
            paragraph(figure.caption, kSmallPoints, kFaint);
        }
        y_ += dots(2.0);
    }

    QPdfWriter& writer_;
    const Report& report_;
    int page_count_;
    mutable QPainter painter_;
    double width_;
    double height_;
    double y_ = 0.0;
    int page_ = 1;
};

// The number of pages, or 0.
int writePages(const Report& report, QIODevice& device, QPageSize::PageSizeId paper, int page_count)
{
    QPdfWriter writer(&device);
    writer.setTitle(report.title);
    writer.setCreator(QStringLiteral("MarsView"));
    writer.setResolution(kDotsPerInch);
    writer.setPageLayout(QPageLayout(QPageSize(paper), QPageLayout::Portrait,
                                     QMarginsF(kMarginMm, kMarginMm, kMarginMm, 12.0),
                                     QPageLayout::Millimeter));
    ReportPages pages(writer, report, page_count);
    if (!pages.isActive()) {
        return 0;
    }
    pages.write();
    return pages.pageCount();
}

} // namespace

Status writeReportPdf(const Report& report, const QString& file, QPageSize::PageSizeId paper)
{
    // A first run counts the pages, without the picture.
    Report draft = report;
    draft.map.picture =
        QImage(report.map.picture.size().scaled(80, 80, Qt::KeepAspectRatio), QImage::Format_RGB32);
    draft.map.picture.fill(Qt::white);
    QBuffer scratch;
    scratch.open(QIODevice::WriteOnly);
    const int page_count = writePages(draft, scratch, paper, 0);

    QSaveFile out(file);
    bool is_written = out.open(QIODevice::WriteOnly);
    if (is_written) {
        is_written = writePages(report, out, paper, page_count) > 0;
    }
    if (!is_written || !out.commit()) {
        return Error{ErrorCode::Unreadable,
                     //: %1 is a file, %2 the reason
                     QCoreApplication::translate(
                         "Report", "%1: cannot write the report (%2); choose another folder")
                         .arg(file, out.errorString())
                         .toStdString()};
    }
    return Done{};
}

} // namespace marsview
