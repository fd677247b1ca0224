// The scale bar over the map.
#pragma once

#include "core/view/scale_bar.h"

#include <QWidget>

#include <optional>

namespace marsview {

/// Shows a round length on the ground in the middle of the view. The plate keeps its width, so that
/// its neighbors stay in place while the bar grows and shrinks. Ignores the mouse.
class ScaleBarView final : public QWidget {
    Q_OBJECT

public:
    explicit ScaleBarView(QWidget* parent = nullptr);

    /// For a camera over a plane. `viewport` is the map's in device pixels.
    void setCamera(const OrbitCamera& camera, const Viewport& viewport);
    /// The length of a pixel of the widget on the ground, in meters.
    void setScale(double meters_per_pixel);
    /// Hides the bar: no map is shown.
    void clear();
    /// The length of the bar, in pixels, when it is longest. Positive.
    void setLongestBar(int width);

    const std::optional<ScaleBar>& bar() const noexcept { return bar_; }
    /// Empty while there is nothing to show.
    QSize sizeHint() const override;

Q_SIGNALS:
    /// There is more or less to show than before.
    void roomChanged();

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void refresh();

    double meters_per_pixel_ = 0.0; // of the widget, not of the device
    int longest_bar_ = 130;
    std::optional<ScaleBar> bar_;
};

} // namespace marsview
