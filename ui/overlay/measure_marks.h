// Handles and labels of the measurements on the map.
#pragma once

#include "ui/text/number_text.h"

#include <QWidget>

namespace marsview {

class MeasureController;

/// Covers its parent, the view, and is transparent to the mouse. Handles and labels keep their size
/// on screen; those that the terrain hides are faint.
class MeasureMarks final : public QWidget {
    Q_OBJECT

public:
    MeasureMarks(MeasureController& controller, QWidget* view);

    void setHeightUnit(HeightUnit unit);

protected:
    void paintEvent(QPaintEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    MeasureController& controller_;
    HeightUnit unit_ = HeightUnit::Meters;
};

} // namespace marsview
