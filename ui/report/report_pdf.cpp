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
#include <numeric>
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

constexpr double kRowGap = dots(1.6);  // between the rows of a table, with the rule in its middle
constexpr double kFactGap = dots(8.0); // between the columns of facts

// ReportPages from top to bottom. Lengths are dots.
class ReportPages {
public:
    // `page_count` of an earlier run, for the page numbers; 0: a run that counts them, without
    // pictures.
    ReportPages(QPdfWriter& writer, const Report& report, int page_count)
        : writer_(writer)
        , report_(report)
        , page_count_(page_count)
        , painter_(&writer)
        , width_(writer.width())
        , height_(writer.height() - dots(9.0)) // without the footer
    {}

    bool isActive() const { return painter_.isActive(); }
    const std::vector<QStringList>& pages() const { return pages_; }

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
    int page() const { return static_cast<int>(pages_.size()); }
    bool isDraft() const { return page_count_ == 0; }

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
                              .arg(page())
                              .arg(std::max(page(), page_count_)));
    }

    void nextPage()
    {
        footer();
        writer_.newPage();
        pages_.emplace_back();
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
        pages_.back().append(text);
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
        if (!isDraft()) {
            QSvgRenderer renderer(svg);
            renderer.render(&painter_, area);
        }
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
        if (!isDraft()) {
            painter_.drawImage(QRectF(left, y_, width, height), map.picture);
        }
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
        const double note = section.note.isEmpty()
                                ? 0.0
                                : heightOf(section.note, font(kTextPoints), width_) + dots(1.0);
        double below = 0.0;
        for (const ReportFigure& figure : section.figures) {
            below += figureHeight(figure);
        }
        if (below > 0.0) {
            below += factsHeight(section.facts);
        }
        const double top = metrics(heading).height() + dots(5.0) + note;
        const double least = openingHeight(section);
        ensure(top + (top + below <= height_ ? std::max(below, least) : least));
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

    // Of what must follow a heading and its note on the same page: all facts if they are few, the
    // first rows of the table.
    double openingHeight(const ReportSection& section) const
    {
        constexpr qsizetype kFewFacts = 12;
        if (!section.facts.isEmpty()) {
            return section.facts.size() <= kFewFacts ? factsHeight(section.facts) : dots(20.0);
        }
        if (section.table && section.figures.isEmpty()) {
            return openingHeight(layoutOf(*section.table));
        }
        return dots(20.0);
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
        pages_.back() += row;
        y_ += height + 0.5 * kRowGap;
    }

    struct TableLayout {
        std::vector<double> widths;
        double header = 0.0;
        std::vector<double> rows; // heights with the rule below
    };

    TableLayout layoutOf(const ReportTable& table) const
    {
        const QFont used = font(kTextPoints);
        TableLayout layout{.widths = columnsOf(table, used), .header = 0.0, .rows = {}};
        layout.header =
            rowHeight(table.header, layout.widths, font(kTextPoints, QFont::DemiBold)) + kRowGap;
        for (const QStringList& row : table.rows) {
            layout.rows.push_back(rowHeight(row, layout.widths, used) + kRowGap);
        }
        return layout;
    }

    static double heightOfRows(const TableLayout& layout, std::size_t first, std::size_t count)
    {
        const auto begin = layout.rows.begin() + static_cast<std::ptrdiff_t>(first);
        return std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(count), 0.0);
    }

    // How many rows from `first` on stay together: two, or three where one would be left.
    std::size_t rowsTogether(const TableLayout& layout, std::size_t first) const
    {
        const std::size_t left = layout.rows.size() - first;
        const std::size_t count = left <= 3 ? left : 2;
        const bool has_room = heightOfRows(layout, first, count) <= height_ - layout.header;
        return has_room ? count : std::min<std::size_t>(left, 1);
    }

    double openingHeight(const TableLayout& layout) const
    {
        return layout.header + heightOfRows(layout, 0, rowsTogether(layout, 0));
    }

    void writeTable(const ReportTable& table)
    {
        const QFont used = font(kTextPoints);
        const QFont bold = font(kTextPoints, QFont::DemiBold);
        const TableLayout layout = layoutOf(table);
        const auto write_header = [&] {
            tableRow(table.header, layout.widths, bold, layout.header - kRowGap);
            rule(y_, kInk, 0.3);
            y_ += 0.5 * kRowGap;
        };
        ensure(openingHeight(layout));
        write_header();
        std::size_t on_page = 0; // rows
        for (std::size_t i = 0; i < layout.rows.size();) {
            // The first two rows of a page are together, and so are the last two of the table.
            const bool is_second_last = i + 2 == layout.rows.size();
            const std::size_t count =
                on_page == 0 || is_second_last ? rowsTogether(layout, i) : std::size_t{1};
            if (on_page > 0 && y_ + heightOfRows(layout, i, count) > height_) {
                nextPage();
                write_header();
                on_page = 0;
                continue;
            }
            for (const std::size_t end = i + count; i < end; ++i) {
                tableRow(table.rows[static_cast<qsizetype>(i)], layout.widths, used,
                         layout.rows[i] - kRowGap);
                rule(y_, kRule, 0.15);
                y_ += 0.5 * kRowGap;
            }
            on_page += count;
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
    std::vector<QStringList> pages_ = std::vector<QStringList>(1); // the texts on each
};

// The texts on each page; empty if it cannot be written.
std::vector<QStringList>
writePages(const Report& report, QIODevice& device, QPageSize::PageSizeId paper, int page_count)
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
        return {};
    }
    pages.write();
    return pages.pages();
}

} // namespace

std::vector<QStringList> reportPages(const Report& report, QPageSize::PageSizeId paper)
{
    QBuffer scratch;
    scratch.open(QIODevice::WriteOnly);
    return writePages(report, scratch, paper, 0);
}

Status writeReportPdf(const Report& report, const QString& file, QPageSize::PageSizeId paper)
{
    const auto page_count = static_cast<int>(reportPages(report, paper).size());

    QSaveFile out(file);
    bool is_written = out.open(QIODevice::WriteOnly);
    if (is_written) {
        is_written = !writePages(report, out, paper, page_count).empty();
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
