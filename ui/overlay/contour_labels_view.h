// The elevations of index contours, on the lines.
#pragma once

#include "core/session/contour_labels.h"
#include "ui/text/number_text.h"
#include "ui/widgets/picture_part.h"

#include <QRect>
#include <QTimer>
#include <QWidget>

#include <functional>
#include <optional>
#include <vector>

namespace marsview {

/// What a view of the terrain knows of contours.
struct ContourView {
    using Widths = std::function<double(double elevation_m)>;

    /// The labels of its picture; empty without contours.
    std::function<std::vector<ContourLabel>(
        const ContourLabelOptions& options, double height_px, const Widths& width_of)>
        labels;
    /// Where a label is now; empty if it is not in the picture.
    std::function<std::optional<ContourLabel>(const ContourLabel& label)> follow;
    std::function<Viewport()> viewport;
    std::function<double()> exaggeration;
};

/// Covers a view and is transparent to the mouse. Labels are found when the picture is at rest,
/// and move with the terrain until then. Numbers are meters; with another unit of elevations, they
/// say so.
class ContourLabelsView final : public QWidget {
    Q_OBJECT

public:
    ContourLabelsView(QWidget& view, ContourView contours);

    /// To be called when the picture is at rest, when the camera has moved, and when there are
    /// other layers or another look.
    void find();
    void follow();
    void clear();

    void setHeightUnit(HeightUnit unit);
    /// Boxes in points of the screen that labels keep clear of.
    void setObstacles(std::function<std::vector<QRectF>()> obstacles);
    /// As they are painted now.
    const std::vector<ContourLabel>& labels() const noexcept { return shown_; }
    QString textOf(double elevation_m) const;

    /// The labels of a picture of `size` pixels that another camera has, as large as in the view
    /// where it is as high. They keep clear of `obstacles`, in pixels. `labels_of` is as
    /// ContourView's.
    std::vector<PicturePart> partsFor(const decltype(ContourView::labels)& labels_of,
                                      const QSize& size,
                                      const std::vector<QRect>& obstacles) const;

protected:
    void paintEvent(QPaintEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    double widthOf(double elevation_m) const;
    double lineHeight() const;
    void draw(QPainter& painter, const ContourLabel& label, double scale) const;

    ContourView contours_;
    HeightUnit unit_ = HeightUnit::Meters;
    std::function<std::vector<QRectF>()> obstacles_;
    std::vector<ContourLabel> found_; // in the last picture at rest
    std::vector<ContourLabel> shown_;
};

} // namespace marsview
