// A histogram of elevations with the ends of a color stretch.
#pragma once

#include "core/terrain/height_histogram.h"
#include "core/view/color_ramp.h"

#include <QWidget>

#include <memory>
#include <optional>

namespace marsview {

struct StretchPlotContent {
    std::shared_ptr<const HeightHistogram> histogram; // null while it is being counted
    HeightRange all{};                                // of the layer: the ends of the plot
    HeightRange stretched{};                          // the ends that can be dragged
    const ColorRamp* ramp = nullptr;
};

/// Bars in the colors of the terrain; two lines mark the ends of the stretch and can be dragged
/// with the mouse. Fields next to the plot do the same for the keyboard.
class StretchPlot final : public QWidget {
    Q_OBJECT

public:
    explicit StretchPlot(QWidget* parent = nullptr);

    void setContent(const StretchPlotContent& content);
    QSize sizeHint() const override { return {320, 110}; }
    QSize minimumSizeHint() const override { return {200, 80}; }

    /// Horizontal position of an elevation in the widget; beyond the plot at its edge.
    int positionOf(double height_m) const;

Q_SIGNALS:
    /// Metres, low < high.
    void endsDragged(double low_m, double high_m);
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
    double heightAt(int x) const;
    std::optional<End> endAt(int x) const;
    void drag(int x);

    StretchPlotContent content_;
    std::optional<End> dragged_;
};

} // namespace marsview
