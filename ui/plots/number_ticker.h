// Numbers at the axes of diagrams as the rest of the window has them.
#pragma once

#include "ui/plots/custom_plot.h"
#include "ui/text/number_text.h"

#include <algorithm>

namespace marsview {

/// With groups of digits and true minus signs.
class NumberTicker final : public QCPAxisTicker {
public:
    QString
    getTickLabel(double tick, const QLocale& /*locale*/, QChar /*format*/, int precision) override
    {
        return shortNumberText(tick, std::max(precision, 6));
    }
};

} // namespace marsview
