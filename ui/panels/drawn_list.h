// The table of drawn items of one kind.
#pragma once

#include "ui/drawing/drawn_item.h"

#include <QTreeWidget>

#include <cstdint>
#include <memory>
#include <vector>

class QMenu;

namespace marsview {

class DrawingBase;

/// A row for each item. Names and notes are edited in place; a click on a column's title sorts by
/// it; several rows can be selected, colored and removed together.
class DrawnList : public QTreeWidget {
    Q_OBJECT

public:
    struct Columns {
        QStringList titles;
        int name = 0;
        int note = 0;
    };

    DrawnList(DrawingBase& drawing, const Columns& columns, QWidget* parent);

    /// To be called when items, or what is known of them, changed.
    void showItems();
    /// In the order of the rows.
    std::vector<std::uint32_t> selectedIds() const;
    void removeSelected();

protected:
    /// The columns other than name and note.
    virtual void fill(QTreeWidgetItem& row, const DrawnItem& item) = 0;
    /// Whether a row has to be filled again although its item is as it was.
    virtual bool isStale(const QTreeWidgetItem& /*row*/, const DrawnItem& /*item*/) const
    {
        return true;
    }
    /// Whether row `a` comes before row `b` where the list is sorted by `column`.
    virtual bool isBefore(const QTreeWidgetItem& a, const QTreeWidgetItem& b, int column) const;
    /// What the context menu offers for items, besides what all kinds have.
    virtual void addActions(QMenu& /*menu*/, const std::vector<std::uint32_t>& /*ids*/) {}

    void changeEvent(QEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    class Row;

    static std::uint32_t idOf(const QTreeWidgetItem& row);
    void fillRow(QTreeWidgetItem& row, const DrawnItem& item);
    void restoreSelection(const std::vector<std::uint32_t>& selected);
    void edit(QTreeWidgetItem& row, int column);
    void askColor(const std::vector<std::uint32_t>& ids);

    DrawingBase& drawing_;
    std::shared_ptr<const void> shown_; // the items that the rows were filled from
    Columns columns_;
    bool is_filling_ = false;
    bool is_notifying_ = false; // of a change that the list itself made
};

} // namespace marsview
