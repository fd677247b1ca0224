// A report on pages.
#pragma once

#include "core/base/result.h"
#include "ui/report/report.h"

#include <QPageSize>
#include <QStringList>

#include <vector>

namespace marsview {

/// Writes a PDF, with text as text and drawings as curves. Replaces a file of that name only as a
/// whole. Unreadable if it cannot be written. GUI thread, because drawings need fonts.
Status writeReportPdf(const Report& report, const QString& file, QPageSize::PageSizeId paper);

/// The titles, headings, paragraphs and cells of tables on each of its pages, in their order. A
/// heading is on the page of what follows it: its note, its figures, or two rows of its table. No
/// row of a table is alone on a page if the table has more. GUI thread.
std::vector<QStringList> reportPages(const Report& report, QPageSize::PageSizeId paper);

} // namespace marsview
