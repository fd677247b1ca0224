// Handles and labels of the measurements on the map.
#pragma once

#include "ui/overlay/picture_part.h"
#include "ui/text/number_text.h"

#include <QList>
#include <QRectF>
#include <QWidget>

#include <functional>
#include <optional>
#include <vector>

class QPainter;

namespace marsview {

class MeasureController;

/// Covers its parent, the view, and is transparent to the mouse. Handles and labels keep their size
/// on screen; those that the terrain hides are faint.
class MeasureMarks final : public QWidget {
    Q_OBJECT

public:
    MeasureMarks(MeasureController& controller, QWidget* view);

    void setHeightUnit(HeightUnit unit);
    /// Widgets that labels keep clear of while they are visible.
    void setObstacles(const QList<QWidget*>& obstacles) { obstacles_ = obstacles; }
    /// Of the labels as they are drawn now, in points.
    std::vector<QRectF> labelBoxes() const;
    /// For a picture of the view of any size: as large as in the view where it is as high.
    std::vector<PicturePart> partsFor(const QSize& picture) const;

protected:
    void paintEvent(QPaintEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    struct Mark {
        QRectF box; // that it fills, in points
        bool is_label = false;
        std::function<void(QPainter&)> draw;
    };
    std::vector<Mark> marks() const;
    std::optional<QRectF> labelBox(QPointF place, const QSizeF& size) const;

    MeasureController& controller_;
    HeightUnit unit_ = HeightUnit::Meters;
    QList<QWidget*> obstacles_;
};

} // namespace marsview
