// A report on pages.
#pragma once

#include "core/base/result.h"
#include "ui/report/report.h"

#include <QPageSize>

namespace marsview {

/// Writes a PDF, with text as text and drawings as curves. Replaces a file of that name only as a
/// whole. Unreadable if it cannot be written. GUI thread, because drawings need fonts.
Status writeReportPdf(const Report& report, const QString& file, QPageSize::PageSizeId paper);

} // namespace marsview
