#include "ui/panels/drawn_list.h"

#include "ui/drawing/drawing_base.h"
#include "ui/panels/drawn_model.h"
#include "ui/widgets/focus_frame.h"

#include <QAbstractButton>
#include <QColorDialog>
#include <QContextMenuEvent>
#include <QHeaderView>
#include <QKeyEvent>
#include <QMenu>
#include <QScopedValueRollback>

#include <algorithm>
#include <unordered_set>

namespace marsview {
namespace {

constexpr int kRowPadding = 6; // above and below the text, together

} // namespace

DrawnList::DrawnList(DrawingBase& drawing, const Columns& columns, QWidget* parent)
    : QTableView(parent)
    , drawing_(drawing)
    , columns_(columns)
    , model_(new DrawnModel(*this))
{
    new FocusFrame(this, FocusFrame::Ground::Panel); // rows may be missing or selected
    setModel(model_);
    setShowGrid(false);
    setWordWrap(false);
    setTabKeyNavigation(false);
    setCornerButtonEnabled(false);
    findChild<QAbstractButton*>()->setAccessibleName(tr("Select all"));
    setEditTriggers(QAbstractItemView::EditKeyPressed);
    setSelectionBehavior(QAbstractItemView::SelectRows);
    setSelectionMode(QAbstractItemView::ExtendedSelection);
    // All columns are in sight: arrow keys choose rows and never scroll names away.
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    verticalHeader()->hide();
    verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
    verticalHeader()->setDefaultSectionSize(fontMetrics().height() + kRowPadding);
    horizontalHeader()->setHighlightSections(false);
    horizontalHeader()->setDefaultAlignment(Qt::AlignLeading | Qt::AlignVCenter);
    horizontalHeader()->setMinimumSectionSize(40);
    horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
    horizontalHeader()->setSortIndicatorClearable(true);
    sortByColumn(-1, Qt::AscendingOrder); // as they were made
    setSortingEnabled(true);
    setMinimumWidth(180);
    connect(this, &QTableView::activated, this, [this](const QModelIndex& index) {
        if (index.column() == columns_.note) {
            edit(index);
        } else {
            drawing_.show(model_->idAt(index.row()));
        }
    });
}

DrawnList::~DrawnList() = default;

int DrawnList::rowCount() const
{
    return model_->rowCount();
}

QString DrawnList::textAt(int row, int column) const
{
    return model_->index(row, column).data().toString();
}

void DrawnList::setTextAt(int row, int column, const QString& text)
{
    model_->setData(model_->index(row, column), text, Qt::EditRole);
}

std::vector<std::uint32_t> DrawnList::selectedIds() const
{
    std::vector<int> rows;
    for (const QItemSelectionRange& range : selectionModel()->selection()) {
        for (int row = range.top(); row <= range.bottom(); ++row) {
            rows.push_back(row);
        }
    }
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    std::vector<std::uint32_t> ids;
    ids.reserve(rows.size());
    for (const int row : rows) {
        ids.push_back(model_->idAt(row));
    }
    return ids;
}

void DrawnList::showItems()
{
    // While the list reports a change of its own, Qt still works with the selection.
    if (is_notifying_) {
        QMetaObject::invokeMethod(this, &DrawnList::showItems, Qt::QueuedConnection);
        return;
    }
    const std::vector<std::uint32_t> selected = selectedIds();
    {
        const QScopedValueRollback following(is_following_, true);
        model_->follow();
    }
    viewport()->update();
    fitColumns();
    restoreSelection(selected);
}

// The selection stays while it contains the current item.
void DrawnList::restoreSelection(const std::vector<std::uint32_t>& selected)
{
    const QScopedValueRollback following(is_following_, true);
    const std::uint32_t current = drawing_.currentId();
    const auto current_row = current != 0 ? model_->rowOf(current) : std::nullopt;
    const bool is_kept = std::find(selected.begin(), selected.end(), current) != selected.end();
    const std::vector<std::uint32_t> wanted = !current_row ? std::vector<std::uint32_t>()
                                              : is_kept    ? selected
                                                           : std::vector{current};
    if (selectedIds() != wanted) {
        const std::unordered_set<std::uint32_t> kept(wanted.begin(), wanted.end());
        QItemSelection selection;
        for (int row = 0; !kept.empty() && row < model_->rowCount(); ++row) {
            if (kept.contains(model_->idAt(row))) {
                const int first = row;
                while (row + 1 < model_->rowCount() && kept.contains(model_->idAt(row + 1))) {
                    ++row;
                }
                selection.select(model_->index(first, 0),
                                 model_->index(row, model_->columnCount() - 1));
            }
        }
        selectionModel()->select(selection, QItemSelectionModel::ClearAndSelect);
    }
    const QModelIndex index =
        current_row ? model_->index(*current_row, std::max(0, currentIndex().column()))
                    : QModelIndex();
    if (index != currentIndex()) {
        selectionModel()->setCurrentIndex(index, QItemSelectionModel::NoUpdate);
        if (index.isValid()) {
            scrollTo(index);
        }
    }
}

void DrawnList::currentChanged(const QModelIndex& current, const QModelIndex& previous)
{
    QTableView::currentChanged(current, previous);
    if (!is_following_ && current.isValid()) {
        const QScopedValueRollback notifying(is_notifying_, true);
        drawing_.select(model_->idAt(current.row()));
    }
}

void DrawnList::editAt(std::uint32_t id, int column)
{
    if (const auto row = model_->rowOf(id)) {
        edit(model_->index(*row, column));
    }
}

void DrawnList::askColor(const std::vector<std::uint32_t>& ids)
{
    const DrawnItem* first = drawing_.itemOf(ids.front());
    const Rgb8 color =
        first != nullptr ? first->color.value_or(kCurrentDrawnColor) : kCurrentDrawnColor;
    auto* dialog = new QColorDialog(QColor(color.red, color.green, color.blue), window());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QColorDialog::colorSelected, this, [this, ids](const QColor& chosen) {
        drawing_.setColors(ids, Rgb8{static_cast<std::uint8_t>(chosen.red()),
                                     static_cast<std::uint8_t>(chosen.green()),
                                     static_cast<std::uint8_t>(chosen.blue())});
    });
    dialog->open();
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
    QTableView::keyPressEvent(event);
}

void DrawnList::contextMenuEvent(QContextMenuEvent* event)
{
    const bool is_by_mouse = event->reason() == QContextMenuEvent::Mouse;
    const QModelIndex index =
        is_by_mouse ? indexAt(viewport()->mapFromGlobal(event->globalPos())) : currentIndex();
    if (!index.isValid()) {
        return;
    }
    const std::uint32_t id = model_->idAt(index.row());
    const QPoint place =
        is_by_mouse ? event->globalPos() : viewport()->mapToGlobal(visualRect(index).bottomLeft());
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
    connect(rename, &QAction::triggered, this, [this, id] { editAt(id, columns_.name); });
    QAction* note = menu->addAction(tr("Edit No&te"));
    note->setEnabled(is_one);
    connect(note, &QAction::triggered, this, [this, id] { editAt(id, columns_.note); });
    connect(menu->addAction(tr("&Color…")), &QAction::triggered, this,
            [this, ids] { askColor(ids); });
    QAction* usual = menu->addAction(tr("&Usual Color"));
    usual->setEnabled(std::any_of(ids.begin(), ids.end(), [this](std::uint32_t each) {
        const DrawnItem* item = drawing_.itemOf(each);
        return item != nullptr && item->color;
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
