// Color contrast by WCAG 2.1.
#pragma once

#include <QColor>

#include <algorithm>
#include <cmath>

namespace marsview {

/// Relative luminance, 0 to 1.
inline double luminance(const QColor& color)
{
    const auto linear = [](double c) {
        return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) +
           0.0722 * linear(color.blueF());
}

/// 1 for equal colors, 21 for black on white.
inline double contrast(const QColor& a, const QColor& b)
{
    const auto [low, high] = std::minmax({luminance(a), luminance(b)});
    return (high + 0.05) / (low + 0.05);
}

} // namespace marsview
