// Handles and labels of the measurements on the map.
#pragma once

#include "ui/overlay/drawn_marks.h"
#include "ui/text/number_text.h"

namespace marsview {

class MeasureController;

/// Labels are results. Those that the terrain hides are faint.
class MeasureMarks final : public DrawnMarks {
    Q_OBJECT

public:
    MeasureMarks(MeasureController& controller, QWidget* view);

    void setHeightUnit(HeightUnit unit);

private:
    std::vector<Mark> marks() const override;

    MeasureController& controller_;
    HeightUnit unit_ = HeightUnit::Meters;
};

} // namespace marsview
