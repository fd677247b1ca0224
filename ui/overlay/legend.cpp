#include "ui/overlay/legend.h"

#include "ui/text/overlay_text.h"
#include "ui/widgets/plate.h"

#include <QFontMetrics>
#include <QPainter>
#include <QPainterPath>
#include <QStyle>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

constexpr int kRampWidth = 12;
constexpr int kTickLength = 4;
constexpr int kLineGap = 4;
constexpr int kTicksMost = 7;
constexpr double kLinesOfText = 6.5; // as high as the ramp is
constexpr int kArrowHeight = 6;
constexpr int kWidestHeading = 190;
constexpr double kBeyondShare = 1e-3; // of the ramp's range: less beyond its ends is not marked

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

// A triangle from its tip; a negative height points down. A rim keeps dark ends visible.
void drawArrow(QPainter& painter, QPointF tip, QSizeF size, const QColor& color)
{
    QPainterPath path(tip);
    path.lineTo(tip + QPointF(-size.width() / 2.0, size.height()));
    path.lineTo(tip + QPointF(size.width() / 2.0, size.height()));
    path.closeSubpath();
    painter.setPen(QPen(overlayTextColor(), 1.0));
    painter.setBrush(color);
    painter.drawPath(path);
}

// A long text broken where its lines are the most even: the legend hides as little of the map as it
// can.
QStringList inTwoLines(const QString& text, const QFontMetrics& metrics)
{
    constexpr int kLongChars = 18;
    if (metrics.horizontalAdvance(text) <= kLongChars * metrics.averageCharWidth()) {
        return {text};
    }
    QStringList best{text};
    int narrowest = metrics.horizontalAdvance(text);
    for (qsizetype at = text.indexOf(QLatin1Char(' ')); at >= 0;
         at = text.indexOf(QLatin1Char(' '), at + 1)) {
        const QStringList lines{text.first(at), text.sliced(at + 1)};
        const int width =
            std::max(metrics.horizontalAdvance(lines[0]), metrics.horizontalAdvance(lines[1]));
        if (width < narrowest) {
            narrowest = width;
            best = lines;
        }
    }
    return best;
}

} // namespace

bool LegendContent::operator==(const LegendContent& other) const noexcept
{
    return mode == other.mode && ramp == other.ramp && range.minimum_m == other.range.minimum_m &&
           range.maximum_m == other.range.maximum_m && slopes == other.slopes &&
           contour_interval_m == other.contour_interval_m && unit == other.unit &&
           all.minimum_m == other.all.minimum_m && all.maximum_m == other.all.maximum_m &&
           layer == other.layer && datum == other.datum;
}

Legend::Legend(QWidget* parent)
    : QWidget(parent)
{
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    setAccessibleName(tr("Legend"));
    setAccessibleDescription(tr("What the colors and lines on the map mean"));
}

void Legend::setContent(const LegendContent& content)
{
    if (content == content_) {
        return;
    }
    const QSize room = sizeHint();
    content_ = content;
    const bool is_slope = content.mode == ShadingMode::Slope;
    low_ = is_slope ? content.slopes.minimum.degrees() : shown(content.range.minimum_m);
    high_ = is_slope ? content.slopes.maximum.degrees() : shown(content.range.maximum_m);
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

bool Legend::isOfHeights() const
{
    return hasRamp() && content_.mode == ShadingMode::Tint;
}

double Legend::shown(double height_m) const
{
    return inUnit(height_m, content_.unit);
}

bool Legend::hasHigher() const
{
    const HeightRange& range = content_.range;
    if (hasRamp() && content_.mode == ShadingMode::Slope) {
        return content_.slopes.maximum < Angle::degrees(90.0);
    }
    return isOfHeights() && content_.all.maximum_m > content_.all.minimum_m &&
           content_.all.maximum_m >
               range.maximum_m + kBeyondShare * (range.maximum_m - range.minimum_m);
}

bool Legend::hasLower() const
{
    const HeightRange& range = content_.range;
    if (hasRamp() && content_.mode == ShadingMode::Slope) {
        return content_.slopes.minimum > Angle();
    }
    return isOfHeights() && content_.all.maximum_m > content_.all.minimum_m &&
           content_.all.minimum_m <
               range.minimum_m - kBeyondShare * (range.maximum_m - range.minimum_m);
}

// Labels count in so many meters: kilometers where these are round. Feet stay feet.
double Legend::kilo() const
{
    const bool is_long = content_.unit == HeightUnit::Meters && ticks_.step >= 1000.0;
    return content_.mode == ShadingMode::Tint && is_long ? 1000.0 : 1.0;
}

QString Legend::title() const
{
    if (content_.mode == ShadingMode::Slope) {
        //: Title of the legend of slopes in degrees
        return tr("Slope (°)");
    }
    //: Title of the legend of elevations; %1 is the unit of its numbers
    return tr("Elevation (%1)")
        .arg(kilo() == 1000.0 ? QStringLiteral("km") : unitSymbol(content_.unit));
}

// Above the ramp: the layer, the quantity and its datum.
QStringList Legend::headings() const
{
    QStringList lines;
    if (!content_.layer.isEmpty()) {
        lines.append(content_.layer);
    }
    lines.append(title());
    const QFontMetrics metrics(font());
    if (content_.mode == ShadingMode::Tint && !content_.datum.isEmpty()) {
        lines += inTwoLines(content_.datum, metrics);
    }
    for (QString& line : lines) {
        line = metrics.elidedText(line, Qt::ElideMiddle, kWidestHeading);
    }
    return lines;
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
    return numberText(value / kilo(), ticks_.step / kilo());
}

QString Legend::rampSummary() const
{
    if (!hasRamp()) {
        return {};
    }
    if (content_.mode == ShadingMode::Slope) {
        const double step = roundNumberBelow((high_ - low_) / 10.0);
        return tr("Legend: slope from %1° to %2°")
            .arg(numberText(low_, step), numberText(high_, step));
    }
    // Colors resolve a hundredth of the range.
    const double step = roundNumberAbove((high_ - low_) / 100.0);
    const auto text = [&](double value) {
        //: %1 is an elevation, %2 its unit
        return tr("%1 %2").arg(numberText(value, step), unitSymbol(content_.unit));
    };
    //: %1 and %2 are elevations
    QString summary = tr("Legend: elevation from %1 to %2").arg(text(low_), text(high_));
    if (!content_.datum.isEmpty()) {
        //: %1 describes a legend, %2 is what its elevations refer to, such as "areoid"
        summary = tr("%1 (%2)").arg(summary, content_.datum);
    }
    if (!content_.layer.isEmpty()) {
        //: %1 describes the legend of a layer, %2 is the layer
        summary = tr("%1, layer %2").arg(summary, content_.layer);
    }
    if (hasLower()) {
        //: %1 describes a legend, %2 is an elevation below its lower end
        summary = tr("%1, lowest %2").arg(summary, text(shown(content_.all.minimum_m)));
    }
    if (hasHigher()) {
        //: %1 describes a legend, %2 is an elevation above its upper end
        summary = tr("%1, highest %2").arg(summary, text(shown(content_.all.maximum_m)));
    }
    return summary;
}

QString Legend::summary() const
{
    const QString text = rampSummary();
    if (contourText().isEmpty()) {
        return text.isEmpty() ? tr("Legend") : text;
    }
    const QString interval = lengthText(content_.contour_interval_m);
    return text.isEmpty() ? tr("Legend: contour lines every %1").arg(interval)
                          //: %1 describes the colors of a legend, %2 is the interval of contours
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
        width = kRampWidth + kTickLength + kLineGap + labels;
        for (const QString& line : headings()) {
            width = std::max(width, metrics.horizontalAdvance(line));
        }
        height = static_cast<int>(headings().size()) * metrics.height() + kLineGap +
                 static_cast<int>(metrics.height() * kLinesOfText) + metrics.height() / 2 +
                 kLineGap + 2 * kArrowHeight;
    }
    if (!contours.isEmpty()) {
        width = std::max(width, metrics.horizontalAdvance(contours));
        height += metrics.height() + (hasRamp() ? kLineGap : 0);
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
    // Like QStyle::visualRect, this keeps numbers next to their marks in either direction.
    const Qt::Alignment leading =
        QStyle::visualAlignment(layoutDirection(), Qt::AlignLeft) | Qt::AlignVCenter;
    int top = inside.top();
    if (hasRamp()) {
        for (const QString& line : headings()) {
            drawText(painter, QRect(inside.left(), top, inside.width(), metrics.height()), leading,
                     line);
            top += metrics.height();
        }
        top += kLineGap + metrics.height() / 4 + kArrowHeight;
        const QRect bar = placed(
            {inside.left(), top, kRampWidth, static_cast<int>(metrics.height() * kLinesOfText)});
        painter.setRenderHint(QPainter::SmoothPixmapTransform);
        painter.drawImage(bar, colors_);
        painter.setRenderHint(QPainter::Antialiasing);
        const QRectF area(bar);
        if (hasHigher()) {
            drawArrow(painter, {area.center().x(), area.top() - 1.0 - kArrowHeight},
                      {area.width(), kArrowHeight}, colors_.pixelColor(0, 0));
        }
        if (hasLower()) {
            drawArrow(painter, {area.center().x(), area.bottom() + 1.0 + kArrowHeight},
                      {area.width(), -kArrowHeight}, colors_.pixelColor(0, colors_.height() - 1));
        }
        for (const double value : ticks_.values) {
            const double y = bar.bottom() + 1 - (value - low_) / (high_ - low_) * bar.height();
            const int line = static_cast<int>(std::lround(y));
            const QRect mark = placed({inside.left() + kRampWidth, line, kTickLength, 1});
            painter.fillRect(mark, overlayTextColor());
            drawText(painter,
                     placed({inside.left() + kRampWidth + kTickLength + kLineGap,
                             line - metrics.height() / 2, inside.width(), metrics.height()}),
                     leading, label(value));
        }
        top = bar.bottom() + 1 + metrics.height() / 4 + 2 * kLineGap + kArrowHeight;
    }
    const QString contours = contourText();
    if (!contours.isEmpty()) {
        drawText(painter, QRect(inside.left(), top, inside.width(), metrics.height()), leading,
                 contours);
    }
}

} // namespace marsview
