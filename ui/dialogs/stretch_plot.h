// A histogram of elevations or slopes with the ends of a color stretch.
#pragma once

#include "core/view/color_ramp.h"

#include <QString>
#include <QWidget>

#include <cstdint>
#include <optional>
#include <vector>

namespace marsview {

/// Elevations in meters, or slopes in degrees.
struct PlotRange {
    double low = 0.0;
    double high = 0.0;

    double extent() const noexcept { return high - low; }
};

struct StretchPlotContent {
    std::vector<std::uint64_t> counts; // in equal parts of `counted`; empty while it is counted
    PlotRange counted{};
    PlotRange all{};       // the ends of the plot
    PlotRange stretched{}; // the ends that can be dragged
    PlotRange tinted{};    // over which the ramp is spread
    const ColorRamp* ramp = nullptr;
    // The ends of the plot, with their unit, as they are written below it.
    QString low_text{};
    QString high_text{};
};

/// Bars in the colors of the terrain; two lines mark the ends of the stretch and can be dragged
/// with the mouse. Fields next to the plot do the same for the keyboard.
class StretchPlot final : public QWidget {
    Q_OBJECT

public:
    explicit StretchPlot(QWidget* parent = nullptr);

    void setContent(const StretchPlotContent& content);
    QSize sizeHint() const override { return {320, 110 + fontMetrics().height()}; }
    QSize minimumSizeHint() const override { return {200, 80 + fontMetrics().height()}; }

    /// Horizontal position of a value in the widget; beyond the plot at its edge.
    int positionOf(double value) const;

Q_SIGNALS:
    /// low < high, as in the content.
    void endsDragged(double low, double high);
    /// A drag begins or has ended.
    void dragEnded();

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;

private:
    enum class End { Low, High };

    QRect plot() const;
    double valueAt(int x) const;
    double shareAt(int x) const;
    std::optional<End> endAt(int x) const;
    void drag(int x);

    StretchPlotContent content_;
    std::optional<End> dragged_;
};

} // namespace marsview
