// What the colors on the map mean.
#pragma once

#include "core/base/round_numbers.h"
#include "core/view/color_ramp.h"
#include "core/view/slope_range.h"
#include "core/view/terrain_look.h"
#include "ui/text/number_text.h"

#include <QImage>
#include <QWidget>

namespace marsview {

/// What a legend explains. The ramp outlives it.
struct LegendContent {
    ShadingMode mode = ShadingMode::Tint;
    const ColorRamp* ramp = nullptr; // of the colors in use; null without colors
    HeightRange range{};             // elevations at the ends of the ramp, for Tint
    SlopeRange slopes{};             // slopes there, for Slope
    double contour_interval_m = 0.0; // of the lines drawn; 0 without
    HeightUnit unit = HeightUnit::Meters;
    /// Of the layer. Where it reaches beyond `range`, arrows at the ends of the ramp show it.
    HeightRange all{};
    QString layer{}; // its name, where several layers are in the picture
    QString datum{}; // that elevations refer to; empty where unknown

    bool operator==(const LegendContent& other) const noexcept;
};

/// The ramp with round elevations or slopes next to it, and the interval of the contour lines.
/// Empty if the colors have no meaning. Transparent to the mouse.
class Legend final : public QWidget {
    Q_OBJECT

public:
    explicit Legend(QWidget* parent = nullptr);

    void setContent(const LegendContent& content);
    const LegendContent& content() const noexcept { return content_; }

    /// Empty while there is nothing to explain.
    QSize sizeHint() const override;

    /// All that is shown, and the extremes beyond the ends of the ramp, in words: the accessible
    /// name, and a tooltip.
    QString summary() const;
    /// Some elevations have the color of the upper (lower) end and lie beyond it.
    bool hasHigher() const;
    bool hasLower() const;

Q_SIGNALS:
    /// There is more or less to show than before.
    void roomChanged();

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    bool hasRamp() const;
    bool isOfHeights() const;
    double shown(double value) const;
    double kilo() const;
    QString title() const;
    QStringList headings() const;
    QString contourText() const;
    QString label(double value) const;
    QString rampSummary() const;

    LegendContent content_;
    double low_ = 0.0; // at the ends of the ramp: elevations in content_.unit, or degrees of slope
    double high_ = 0.0;
    RoundTicks ticks_; // in the same unit
    QImage colors_;    // one column, the highest on top
};

} // namespace marsview
