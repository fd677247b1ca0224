// The table of the measurements.
#pragma once

#include "ui/text/number_text.h"

#include <QTreeWidget>

#include <cstdint>

namespace marsview {

class MeasureController;

/// A row for each measurement: its name, result, note and layer. Names and notes are edited in
/// place; a click on a column's title sorts by it.
class MeasureList final : public QTreeWidget {
    Q_OBJECT

public:
    enum Column { NameColumn, ResultColumn, NoteColumn, LayerColumn, ColumnCount };

    explicit MeasureList(MeasureController& controller, QWidget* parent = nullptr);

    void setHeightUnit(HeightUnit unit);
    /// To be called when measurements or their results changed.
    void showItems();

protected:
    void contextMenuEvent(QContextMenuEvent* event) override;

private:
    static std::uint32_t idOf(const QTreeWidgetItem& row);
    void fill(QTreeWidgetItem& row, std::size_t index);
    void edit(const QTreeWidgetItem& row, int column);
    void askColor(std::uint32_t id);

    MeasureController& controller_;
    HeightUnit unit_ = HeightUnit::Meters;
    bool is_filling_ = false;
};

} // namespace marsview
