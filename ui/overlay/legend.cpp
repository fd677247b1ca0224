#include "ui/overlay/legend.h"

#include "ui/overlay/overlay_text.h"
#include "ui/overlay/plate.h"

#include <QFontMetrics>
#include <QPainter>
#include <QStyle>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

constexpr int kBarWidth = 12;
constexpr int kTickLength = 4;
constexpr int kGap = 4;
constexpr int kTicksMost = 7;
constexpr double kLinesOfText = 6.5; // as high as the ramp is

QImage columnOf(const ColorRamp& ramp)
{
    const auto colors = sampledRamp(ramp);
    QImage column(1, static_cast<int>(colors.size()), QImage::Format_RGB32);
    for (int y = 0; y < column.height(); ++y) {
        const Rgb8& color = colors[colors.size() - 1 - static_cast<std::size_t>(y)];
        column.setPixel(0, y, qRgb(color.red, color.green, color.blue));
    }
    return column;
}

} // namespace

bool LegendContent::operator==(const LegendContent& other) const noexcept
{
    return mode == other.mode && ramp == other.ramp && range.minimum_m == other.range.minimum_m &&
           range.maximum_m == other.range.maximum_m &&
           contour_interval_m == other.contour_interval_m;
}

Legend::Legend(QWidget* parent)
    : QWidget(parent)
{
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    setAccessibleName(tr("Legend"));
    setAccessibleDescription(tr("What the colours and lines on the map mean"));
}

void Legend::setContent(const LegendContent& content)
{
    if (content == content_) {
        return;
    }
    const QSize room = sizeHint();
    content_ = content;
    const bool is_slope = content.mode == ShadingMode::Slope;
    low_ = is_slope ? 0.0 : content.range.minimum_m;
    high_ = is_slope ? kSlopeShownMax.degrees() : content.range.maximum_m;
    ticks_ = hasRamp() ? roundTicks(low_, high_, kTicksMost) : RoundTicks{};
    colors_ = hasRamp() ? columnOf(*content.ramp) : QImage();
    setAccessibleName(summary());
    if (sizeHint() != room) {
        updateGeometry();
        Q_EMIT roomChanged();
    }
    update();
}

bool Legend::hasRamp() const
{
    return content_.ramp != nullptr && content_.mode != ShadingMode::Hillshade && high_ > low_ &&
           std::isfinite(high_ - low_);
}

// Labels count in this many metres (or degrees).
double Legend::unit() const
{
    return content_.mode == ShadingMode::Tint && ticks_.step >= 1000.0 ? 1000.0 : 1.0;
}

QString Legend::title() const
{
    if (content_.mode == ShadingMode::Slope) {
        //: Title of the legend of slopes in degrees
        return tr("Slope (°)");
    }
    //: Titles of the legend of heights, with the unit of its numbers
    return unit() == 1000.0 ? tr("Height (km)") : tr("Height (m)");
}

QString Legend::contourText() const
{
    if (!(content_.contour_interval_m > 0.0)) {
        return {};
    }
    //: %1 is the difference in height from one contour line to the next, for example "200 m"
    return tr("Contours %1").arg(lengthText(content_.contour_interval_m));
}

QString Legend::label(double value) const
{
    return numberText(value / unit(), ticks_.step / unit());
}

// For those who hear it: ends of the ramp, unit, interval.
QString Legend::summary() const
{
    QString text;
    if (hasRamp()) {
        // Whole degrees; of heights a hundredth of the range is what colours can tell.
        const double step =
            content_.mode == ShadingMode::Slope ? 1.0 : roundNumberAbove((high_ - low_) / 100.0);
        const QString low = numberText(low_, step);
        const QString high = numberText(high_, step);
        text = content_.mode == ShadingMode::Slope
                   ? tr("Legend: slope from %1° to %2°").arg(low, high)
                   : tr("Legend: height from %1 m to %2 m").arg(low, high);
    }
    const QString contours = contourText();
    if (contours.isEmpty()) {
        return text.isEmpty() ? tr("Legend") : text;
    }
    const QString interval = lengthText(content_.contour_interval_m);
    return text.isEmpty() ? tr("Legend: contour lines every %1").arg(interval)
                          //: %1 is what the legend says of colours, %2 the interval of contours
                          : tr("%1, contour lines every %2").arg(text, interval);
}

QSize Legend::sizeHint() const
{
    const QFontMetrics metrics(font());
    const QString contours = contourText();
    int width = 0;
    int height = 0;
    if (hasRamp()) {
        int labels = 0;
        for (const double value : ticks_.values) {
            labels = std::max(labels, metrics.horizontalAdvance(label(value)));
        }
        width =
            std::max(kBarWidth + kTickLength + kGap + labels, metrics.horizontalAdvance(title()));
        height = metrics.height() + kGap + static_cast<int>(metrics.height() * kLinesOfText) +
                 metrics.height() / 2 + kGap;
    }
    if (!contours.isEmpty()) {
        width = std::max(width, metrics.horizontalAdvance(contours));
        height += metrics.height() + (hasRamp() ? kGap : 0);
    }
    return height > 0 ? QSize(width + 2 * kPlatePadding, height + 2 * kPlatePadding - 4)
                      : QSize(0, 0);
}

void Legend::paintEvent(QPaintEvent* /*event*/)
{
    QPainter painter(this);
    const QFontMetrics metrics(font());
    drawPlate(painter, rect());
    const QRect inside =
        rect().adjusted(kPlatePadding, kPlatePadding - 2, -kPlatePadding, -(kPlatePadding - 2));
    const auto placed = [&](const QRect& r) {
        return QStyle::visualRect(layoutDirection(), inside, r);
    };
    // Like QStyle::visualRect, this keeps numbers beside their marks in either direction.
    const Qt::Alignment leading =
        QStyle::visualAlignment(layoutDirection(), Qt::AlignLeft) | Qt::AlignVCenter;
    int top = inside.top();
    if (hasRamp()) {
        drawText(painter, QRect(inside.left(), top, inside.width(), metrics.height()), leading,
                 title());
        top += metrics.height() + kGap + metrics.height() / 4;
        const QRect bar = placed(
            {inside.left(), top, kBarWidth, static_cast<int>(metrics.height() * kLinesOfText)});
        painter.setRenderHint(QPainter::SmoothPixmapTransform);
        painter.drawImage(bar, colors_);
        painter.setRenderHint(QPainter::Antialiasing);
        for (const double value : ticks_.values) {
            const double y = bar.bottom() + 1 - (value - low_) / (high_ - low_) * bar.height();
            const int line = static_cast<int>(std::lround(y));
            const QRect mark = placed({inside.left() + kBarWidth, line, kTickLength, 1});
            painter.fillRect(mark, overlayTextColor());
            drawText(painter,
                     placed({inside.left() + kBarWidth + kTickLength + kGap,
                             line - metrics.height() / 2, inside.width(), metrics.height()}),
                     leading, label(value));
        }
        top = bar.bottom() + 1 + metrics.height() / 4 + 2 * kGap;
    }
    const QString contours = contourText();
    if (!contours.isEmpty()) {
        drawText(painter, QRect(inside.left(), top, inside.width(), metrics.height()), leading,
                 contours);
    }
}

} // namespace marsview
