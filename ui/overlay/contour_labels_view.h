// The elevations of index contours, on the lines.
#pragma once

#include "core/session/contour_labels.h"
#include "ui/text/number_text.h"
#include "ui/widgets/picture_part.h"

#include <QRect>
#include <QTimer>
#include <QWidget>

#include <functional>
#include <vector>

namespace marsview {

class TerrainView;

/// Covers the view and is transparent to the mouse. Labels are found when the picture is at rest,
/// and move with the terrain until then. Numbers are meters; with another unit of elevations, they
/// say so.
class ContourLabelsView final : public QWidget {
    Q_OBJECT

public:
    explicit ContourLabelsView(TerrainView& view);

    void setHeightUnit(HeightUnit unit);
    /// Boxes in points of the screen that labels keep clear of.
    void setObstacles(std::function<std::vector<QRectF>()> obstacles);
    /// As they are painted now.
    const std::vector<ContourLabel>& labels() const noexcept { return shown_; }
    QString textOf(double elevation_m) const;

    /// The labels of a picture of `size` pixels, as large as in the view where it is as high. They
    /// keep clear of `obstacles`, in pixels.
    std::vector<PicturePart> partsFor(const OrbitCamera& camera,
                                      const QSize& size,
                                      const std::vector<QRect>& obstacles) const;

protected:
    void paintEvent(QPaintEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void find();
    void follow();
    double widthOf(double elevation_m) const;
    double lineHeight() const;
    void draw(QPainter& painter, const ContourLabel& label, double scale) const;

    TerrainView& view_;
    HeightUnit unit_ = HeightUnit::Meters;
    std::function<std::vector<QRectF>()> obstacles_;
    std::vector<ContourLabel> found_; // in the last picture at rest
    std::vector<ContourLabel> shown_;
};

} // namespace marsview
