// The table of the measurements.
#pragma once

#include "ui/panels/drawn_list.h"
#include "ui/text/number_text.h"

namespace marsview {

class MeasureController;

/// With the result of each measurement and the layer that it was made on.
class MeasureList final : public DrawnList {
    Q_OBJECT

public:
    enum Column { NameColumn, ResultColumn, NoteColumn, LayerColumn };

    explicit MeasureList(MeasureController& controller, QWidget* parent = nullptr);

    void setHeightUnit(HeightUnit unit);

protected:
    void fitColumns() override;
    QVariant cell(const DrawnItem& item, int column, int role) const override;
    /// Results sort by what they measure, then by size.
    bool isBefore(const DrawnItem& a, const DrawnItem& b, int column) const override;

private:
    MeasureController& controller_;
    HeightUnit unit_ = HeightUnit::Meters;
};

} // namespace marsview
