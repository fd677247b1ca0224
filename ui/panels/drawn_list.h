// The table of drawn items of one kind.
#pragma once

#include "ui/drawing/drawn_item.h"

#include <QTableView>
#include <QVariant>

#include <cstdint>
#include <vector>

class QMenu;

namespace marsview {

class DrawingBase;
class DrawnModel;

/// A row for each item. Names and notes are edited in place; a click on a column's title sorts by
/// it; several rows can be selected, colored and removed together. Rows ask for what they show when
/// they are in sight.
class DrawnList : public QTableView {
    Q_OBJECT

public:
    struct Columns {
        QStringList titles;
        int name = 0;
        int note = 0;
    };

    DrawnList(DrawingBase& drawing, const Columns& columns, QWidget* parent);
    ~DrawnList() override;

    /// To be called when items, or what is known of them, changed.
    void showItems();
    /// In the order of the rows.
    std::vector<std::uint32_t> selectedIds() const;
    void removeSelected();
    int rowCount() const;
    QString textAt(int row, int column) const;
    /// As a user who types it: only names and notes can be changed.
    void setTextAt(int row, int column, const QString& text);

protected:
    /// What a cell shows, in the roles of Qt; names and notes have their texts and swatch already.
    virtual QVariant cell(const DrawnItem& item, int column, int role) const = 0;
    /// Whether item `a` comes before `b` where the list is sorted by `column`.
    virtual bool isBefore(const DrawnItem& a, const DrawnItem& b, int column) const = 0;
    /// The texts of cells may have changed.
    virtual void fitColumns() {}
    /// What the context menu offers for items, besides what all kinds have.
    virtual void addActions(QMenu& /*menu*/, const std::vector<std::uint32_t>& /*ids*/) {}

    void contextMenuEvent(QContextMenuEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void currentChanged(const QModelIndex& current, const QModelIndex& previous) override;

private:
    friend class DrawnModel;

    void restoreSelection(const std::vector<std::uint32_t>& selected);
    void editAt(std::uint32_t id, int column);
    void askColor(const std::vector<std::uint32_t>& ids);

    DrawingBase& drawing_;
    Columns columns_;
    DrawnModel* model_ = nullptr;
    bool is_following_ = false; // the selection follows the items
    bool is_notifying_ = false; // of a change that the list itself made
};

} // namespace marsview
