// Labels over a picture of terrain.
#pragma once

#include "core/geo/coordinate_format.h"
#include "core/graticule/graticule_lines.h"
#include "core/session/name_labels.h"
#include "core/view/camera.h"
#include "core/view/label_placement.h"
#include "ui/widgets/picture_part.h"
#include "ui/widgets/rimmed_label.h"

#include <QHash>
#include <QPixmap>
#include <QPointF>
#include <QRect>
#include <QRectF>
#include <QSize>
#include <QString>
#include <QTimer>
#include <QWidget>

#include <functional>
#include <optional>
#include <vector>

namespace marsview {

/// Covers the picture, its parent, and is transparent to the mouse. Labels are placed again when
/// other overlays appear, move or disappear.
class LabelsOverlay : public QWidget {
    Q_OBJECT

public:
    explicit LabelsOverlay(QWidget& picture);

    /// Widgets that labels keep clear of while they are visible.
    void setObstacles(std::vector<QWidget*> obstacles);

protected:
    struct PlacedName {
        QString text;
        QRectF box; // in points of the screen
        LabelFont size = LabelFont::Small;
        std::optional<QPointF> point; // next to the label
    };

    /// Places the labels.
    virtual void showSight() = 0;
    /// The same, once all that is moving has moved.
    void showSightSoon() { soon_.start(); }
    /// Of the visible obstacles, in pixels; `scale` pixels per point.
    std::vector<LabelBox> obstacleBoxes(double scale) const;
    /// What labels of a picture of any size keep clear of, in its pixels: `obstacles` in it, and
    /// `boxes` of the window, in points, which are as far from the middle and from the top there.
    std::vector<LabelBox> takenIn(const QSize& picture,
                                  const std::vector<QRect>& obstacles,
                                  const std::vector<QRectF>& boxes) const;
    std::vector<PlacedName>
    namesIn(const CameraPose& camera, const NameLabelOptions& options, NameLabels& names) const;
    /// How the values of a graticule are written.
    struct ValueFormat {
        Angle longitude_step{};
        Angle latitude_step{};
        const CoordinateFormat& coordinates;
        const Body* body = nullptr; // null if unknown
    };
    /// The values that have room, within the picture; adds their boxes to `taken`. None is at a
    /// place that cannot be seen.
    std::vector<PlacedName> valuesIn(const std::vector<GraticuleLabel>& labels,
                                     const ValueFormat& format,
                                     const Viewport& viewport,
                                     double scale,
                                     const std::function<bool(const ScenePoint&)>& is_visible,
                                     std::vector<LabelBox>& taken) const;
    /// Labels that were placed in a picture of its own, with `scale` pixels per point.
    std::vector<PicturePart> partsOf(const std::vector<PlacedName>& labels, double scale) const;
    /// What a cursor there needs: labels that would cover it are left out. In points.
    static QRectF aroundCursor(QPointF place);
    static LabelBox scaled(const QRectF& box, double scale);
    static QRectF points(const LabelBox& box, double scale);

    /// Of a label; valid until the next call.
    const QPixmap& picture(const QString& text, LabelFont size);
    void forgetPictures() { pictures_.clear(); }

    void changeEvent(QEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    std::vector<QWidget*> obstacles_;
    QTimer soon_;
    QHash<QString, QPixmap> pictures_; // by text and size
};

} // namespace marsview
