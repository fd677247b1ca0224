// What the colours on the map mean.
#pragma once

#include "core/view/color_ramp.h"
#include "core/view/round_numbers.h"
#include "core/view/terrain_look.h"

#include <QImage>
#include <QWidget>

namespace marsview {

/// What a legend explains. The ramp outlives it.
struct LegendContent {
    ShadingMode mode = ShadingMode::Tint;
    const ColorRamp* ramp = nullptr; // of the colours in use; null where there are none
    HeightRange range{};             // heights at the ends of the ramp, for Tint
    double contour_interval_m = 0.0; // of the lines drawn; 0 without

    bool operator==(const LegendContent& other) const noexcept;
};

/// The ramp with round heights or slopes beside it, and the interval of the contour lines. Nothing
/// where colours mean nothing. Lets the mouse through.
class Legend final : public QWidget {
    Q_OBJECT

public:
    explicit Legend(QWidget* parent = nullptr);

    void setContent(const LegendContent& content);
    const LegendContent& content() const noexcept { return content_; }

    /// Empty while there is nothing to explain.
    QSize sizeHint() const override;

Q_SIGNALS:
    /// There is more or less to show than before.
    void roomChanged();

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    bool hasRamp() const;
    double unit() const;
    QString title() const;
    QString contourText() const;
    QString label(double value) const;
    QString summary() const;

    LegendContent content_;
    double low_ = 0.0; // at the ends of the ramp: metres, or degrees of slope
    double high_ = 0.0;
    RoundTicks ticks_;
    QImage colors_; // one column, the highest on top
};

} // namespace marsview
