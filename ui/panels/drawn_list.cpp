#include "ui/panels/drawn_list.h"

#include "ui/drawing/drawing_base.h"
#include "ui/widgets/icons.h"

#include <QColorDialog>
#include <QContextMenuEvent>
#include <QHeaderView>
#include <QIcon>
#include <QKeyEvent>
#include <QMenu>
#include <QScopedValueRollback>

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace marsview {
namespace {

constexpr int kSwatchSide = 10;
constexpr int kIdRole = Qt::UserRole;

} // namespace

class DrawnList::Row final : public QTreeWidgetItem {
public:
    using QTreeWidgetItem::QTreeWidgetItem;

    const DrawnItem* shown = nullptr; // that it was filled from

    bool operator<(const QTreeWidgetItem& other) const override
    {
        const auto* list = static_cast<const DrawnList*>(treeWidget());
        return list->isBefore(*this, other, list->sortColumn());
    }
};

DrawnList::DrawnList(DrawingBase& drawing, const Columns& columns, QWidget* parent)
    : QTreeWidget(parent)
    , drawing_(drawing)
    , columns_(columns)
{
    setRootIsDecorated(false);
    setUniformRowHeights(true);
    setColumnCount(static_cast<int>(columns.titles.size()));
    setHeaderLabels(columns.titles);
    setEditTriggers(QAbstractItemView::EditKeyPressed);
    setSelectionMode(QAbstractItemView::ExtendedSelection);
    // All columns are in sight: arrow keys choose rows and never scroll names away.
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    header()->setMinimumSectionSize(40);
    header()->setSectionResizeMode(QHeaderView::Stretch);
    header()->setSortIndicatorClearable(true);
    sortByColumn(-1, Qt::AscendingOrder); // as they were made
    setSortingEnabled(true);
    setMinimumWidth(260);
    connect(this, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* row) {
        if (!is_filling_ && row != nullptr) {
            const QScopedValueRollback notifying(is_notifying_, true);
            drawing_.select(idOf(*row));
        }
    });
    connect(this, &QTreeWidget::itemActivated, this, [this](QTreeWidgetItem* row, int column) {
        if (column == columns_.note) {
            editItem(row, columns_.note);
        } else {
            drawing_.show(idOf(*row));
        }
    });
    connect(this, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* row, int column) {
        if (!is_filling_) {
            const QScopedValueRollback notifying(is_notifying_, true);
            edit(*row, column);
        }
    });
}

std::uint32_t DrawnList::idOf(const QTreeWidgetItem& row)
{
    return row.data(0, kIdRole).toUInt();
}

bool DrawnList::isBefore(const QTreeWidgetItem& a, const QTreeWidgetItem& b, int column) const
{
    return a.text(column).localeAwareCompare(b.text(column)) < 0;
}

std::vector<std::uint32_t> DrawnList::selectedIds() const
{
    QModelIndexList rows = selectionModel()->selectedRows();
    std::sort(rows.begin(), rows.end(),
              [](const QModelIndex& a, const QModelIndex& b) { return a.row() < b.row(); });
    std::vector<std::uint32_t> ids;
    for (const QModelIndex& row : rows) {
        ids.push_back(row.data(kIdRole).toUInt());
    }
    return ids;
}

void DrawnList::showItems()
{
    // While the list reports a change of its own, it still holds rows that sorting would move.
    if (is_notifying_) {
        QMetaObject::invokeMethod(this, &DrawnList::showItems, Qt::QueuedConnection);
        return;
    }
    const QScopedValueRollback filling(is_filling_, true);
    const std::vector<std::uint32_t> selected = selectedIds();
    const std::vector<const DrawnItem*> items = drawing_.drawn();
    setSortingEnabled(false); // rows stay in their places until all are filled
    while (topLevelItemCount() > static_cast<int>(items.size())) {
        delete takeTopLevelItem(topLevelItemCount() - 1);
    }
    QList<QTreeWidgetItem*> added;
    for (std::size_t i = 0; i < items.size(); ++i) {
        auto* row = static_cast<Row*>(topLevelItem(static_cast<int>(i)));
        if (row == nullptr) {
            row = new Row;
            row->setFlags(row->flags() | Qt::ItemIsEditable);
            added.append(row);
        }
        if (row->shown != items[i] || isStale(*row, *items[i])) {
            row->shown = items[i];
            fillRow(*row, *items[i]);
        }
    }
    addTopLevelItems(added);
    shown_ = drawing_.drawnSnapshot();
    setSortingEnabled(true);
    restoreSelection(selected);
}

// The selection stays while it contains the current item.
void DrawnList::restoreSelection(const std::vector<std::uint32_t>& selected)
{
    const std::uint32_t current = drawing_.currentId();
    const std::unordered_set<std::uint32_t> kept(selected.begin(), selected.end());
    const bool is_kept = kept.contains(current);
    QTreeWidgetItem* current_row = nullptr;
    for (int i = 0; i < topLevelItemCount(); ++i) {
        QTreeWidgetItem* row = topLevelItem(i);
        const std::uint32_t id = idOf(*row);
        current_row = id == current ? row : current_row;
        const bool is_selected = is_kept ? kept.contains(id) : id == current;
        if (row->isSelected() != is_selected) {
            row->setSelected(is_selected);
        }
    }
    setCurrentItem(current_row, std::max(0, currentColumn()), QItemSelectionModel::NoUpdate);
    if (current_row != nullptr) {
        scrollToItem(current_row);
    }
}

void DrawnList::fillRow(QTreeWidgetItem& row, const DrawnItem& item)
{
    row.setData(0, kIdRole, item.id);
    row.setText(columns_.name, item.name);
    row.setIcon(columns_.name,
                item.color ? swatch(QColor(item.color->red, item.color->green, item.color->blue),
                                    kSwatchSide)
                           : QIcon());
    row.setText(columns_.note, item.note);
    row.setToolTip(columns_.note, item.note);
    fill(row, item);
}

// Only names and notes can be changed: other texts return.
void DrawnList::edit(QTreeWidgetItem& row, int column)
{
    static_cast<Row&>(row).shown = nullptr; // its text is not that of the item
    if (column == columns_.name) {
        drawing_.rename(idOf(row), row.text(column));
    } else if (column == columns_.note) {
        drawing_.setNote(idOf(row), row.text(column));
    }
    showItems();
}

void DrawnList::askColor(const std::vector<std::uint32_t>& ids)
{
    Rgb8 color = kCurrentDrawnColor;
    for (const DrawnItem* item : drawing_.drawn()) {
        if (item->id == ids.front() && item->color) {
            color = *item->color;
        }
    }
    auto* dialog = new QColorDialog(QColor(color.red, color.green, color.blue), window());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QColorDialog::colorSelected, this, [this, ids](const QColor& chosen) {
        drawing_.setColors(ids, Rgb8{static_cast<std::uint8_t>(chosen.red()),
                                     static_cast<std::uint8_t>(chosen.green()),
                                     static_cast<std::uint8_t>(chosen.blue())});
    });
    dialog->open();
}

// Rows may have colors of the palette.
void DrawnList::changeEvent(QEvent* event)
{
    QTreeWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && topLevelItemCount() > 0) {
        for (int i = 0; i < topLevelItemCount(); ++i) {
            static_cast<Row*>(topLevelItem(i))->shown = nullptr;
        }
        QMetaObject::invokeMethod(this, &DrawnList::showItems, Qt::QueuedConnection);
    }
}

void DrawnList::removeSelected()
{
    if (const std::vector<std::uint32_t> ids = selectedIds(); !ids.empty()) {
        drawing_.removeItems(ids);
    }
}

void DrawnList::keyPressEvent(QKeyEvent* event)
{
    if (event->key() == Qt::Key_Delete && state() != QAbstractItemView::EditingState) {
        removeSelected();
        return;
    }
    QTreeWidget::keyPressEvent(event);
}

void DrawnList::contextMenuEvent(QContextMenuEvent* event)
{
    const bool is_by_mouse = event->reason() == QContextMenuEvent::Mouse;
    QTreeWidgetItem* row =
        is_by_mouse ? itemAt(viewport()->mapFromGlobal(event->globalPos())) : currentItem();
    if (row == nullptr) {
        return;
    }
    const std::uint32_t id = idOf(*row);
    const QPoint place = is_by_mouse ? event->globalPos()
                                     : viewport()->mapToGlobal(visualItemRect(row).bottomLeft());
    // The row may move: the item is the current one from now on.
    drawing_.select(id);
    std::vector<std::uint32_t> ids = selectedIds();
    if (ids.empty()) {
        ids = {id};
    }
    const bool is_one = ids.size() == 1;
    auto* menu = new QMenu(this);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    connect(menu->addAction(tr("&Go There")), &QAction::triggered, this,
            [this, id] { drawing_.show(id); });
    QAction* rename = menu->addAction(tr("Re&name"));
    rename->setEnabled(is_one);
    connect(rename, &QAction::triggered, this, [this] { editItem(currentItem(), columns_.name); });
    QAction* note = menu->addAction(tr("Edit No&te"));
    note->setEnabled(is_one);
    connect(note, &QAction::triggered, this, [this] { editItem(currentItem(), columns_.note); });
    connect(menu->addAction(tr("&Color…")), &QAction::triggered, this,
            [this, ids] { askColor(ids); });
    const std::vector<const DrawnItem*> items = drawing_.drawn();
    QAction* usual = menu->addAction(tr("&Usual Color"));
    usual->setEnabled(std::any_of(items.begin(), items.end(), [&ids](const DrawnItem* item) {
        return item->color && std::find(ids.begin(), ids.end(), item->id) != ids.end();
    }));
    connect(usual, &QAction::triggered, this,
            [this, ids] { drawing_.setColors(ids, std::nullopt); });
    addActions(*menu, ids);
    menu->addSeparator();
    connect(menu->addAction(tr("&Remove")), &QAction::triggered, this,
            [this, ids] { drawing_.removeItems(ids); });
    menu->popup(place);
}

} // namespace marsview
