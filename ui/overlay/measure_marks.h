// Handles and labels of the measurements on the map.
#pragma once

#include "ui/overlay/picture_part.h"
#include "ui/text/number_text.h"

#include <QRectF>
#include <QWidget>

#include <functional>
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
    /// For a picture of the view of any size: as large as in the view where it is as high.
    std::vector<PicturePart> partsFor(const QSize& picture) const;

protected:
    void paintEvent(QPaintEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    struct Mark {
        QRectF box; // that it fills, in points
        std::function<void(QPainter&)> draw;
    };
    std::vector<Mark> marks() const;

    MeasureController& controller_;
    HeightUnit unit_ = HeightUnit::Meters;
};

} // namespace marsview
