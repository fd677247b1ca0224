#include "ui/panels/drawn_model.h"

#include "ui/drawing/drawing_base.h"
#include "ui/widgets/icons.h"

#include <QIcon>

#include <algorithm>

namespace marsview {
namespace {

constexpr int kSwatchSide = 10;
constexpr std::size_t kSingleChangesMax = 100; // beyond, the rows are listed as a whole

} // namespace

DrawnModel::DrawnModel(DrawnList& list)
    : QAbstractTableModel(&list)
    , list_(list)
{}

std::optional<int> DrawnModel::rowOf(std::uint32_t id) const
{
    const auto hit = std::find(rows_.begin(), rows_.end(), id);
    return hit != rows_.end() ? std::optional(static_cast<int>(hit - rows_.begin())) : std::nullopt;
}

const DrawnItem* DrawnModel::itemAt(int row) const
{
    return list_.drawing_.itemOf(idAt(row));
}

void DrawnModel::follow()
{
    const DrawnChanges changes = list_.drawing_.changesSince(known_);
    const std::size_t count =
        changes.added.size() + changes.changed.size() + changes.removed.size();
    if (count > kSingleChangesMax) {
        beginResetModel();
        if (!changes.removed.empty()) {
            std::erase_if(rows_, [&changes](std::uint32_t id) {
                return std::binary_search(changes.removed.begin(), changes.removed.end(), id);
            });
        }
        rows_.insert(rows_.end(), changes.added.begin(), changes.added.end());
        sortRows();
        endResetModel();
        return;
    }
    for (const std::uint32_t id : changes.removed) {
        remove(id);
    }
    std::vector<std::uint32_t> moved;
    for (const std::uint32_t id : changes.changed) {
        const auto place = rows_.begin() + *rowOf(id);
        const bool is_in_place = (place == rows_.begin() || !isBefore(id, *(place - 1))) &&
                                 (place + 1 == rows_.end() || !isBefore(*(place + 1), id));
        if (!is_in_place) {
            moved.push_back(id);
        }
    }
    for (const std::uint32_t id : moved) {
        remove(id);
    }
    for (const std::uint32_t id : moved) {
        insert(id);
    }
    for (const std::uint32_t id : changes.added) {
        insert(id);
    }
}

void DrawnModel::insert(std::uint32_t id)
{
    const auto place =
        std::upper_bound(rows_.begin(), rows_.end(), id,
                         [this](std::uint32_t a, std::uint32_t b) { return isBefore(a, b); });
    const int row = static_cast<int>(place - rows_.begin());
    beginInsertRows({}, row, row);
    rows_.insert(place, id);
    endInsertRows();
}

void DrawnModel::remove(std::uint32_t id)
{
    if (const auto row = rowOf(id)) {
        beginRemoveRows({}, *row, *row);
        rows_.erase(rows_.begin() + *row);
        endRemoveRows();
    }
}

bool DrawnModel::isBefore(std::uint32_t a, std::uint32_t b) const
{
    if (sort_column_ >= 0) {
        const bool is_up = sort_order_ == Qt::AscendingOrder;
        const DrawnItem* first = list_.drawing_.itemOf(is_up ? a : b);
        const DrawnItem* second = list_.drawing_.itemOf(is_up ? b : a);
        if (list_.isBefore(*first, *second, sort_column_)) {
            return true;
        }
        if (list_.isBefore(*second, *first, sort_column_)) {
            return false;
        }
    }
    return a < b;
}

void DrawnModel::sortRows()
{
    std::sort(rows_.begin(), rows_.end(),
              [this](std::uint32_t a, std::uint32_t b) { return isBefore(a, b); });
}

int DrawnModel::rowCount(const QModelIndex& parent) const
{
    return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int DrawnModel::columnCount(const QModelIndex& parent) const
{
    return parent.isValid() ? 0 : static_cast<int>(list_.columns_.titles.size());
}

Qt::ItemFlags DrawnModel::flags(const QModelIndex& index) const
{
    Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemNeverHasChildren;
    if (index.column() == list_.columns_.name || index.column() == list_.columns_.note) {
        flags |= Qt::ItemIsEditable;
    }
    return flags;
}

QVariant DrawnModel::data(const QModelIndex& index, int role) const
{
    const DrawnItem* item = index.isValid() ? itemAt(index.row()) : nullptr;
    if (item == nullptr) {
        return {};
    }
    const bool is_name = index.column() == list_.columns_.name;
    const bool is_note = index.column() == list_.columns_.note;
    const bool is_text = role == Qt::DisplayRole || role == Qt::EditRole;
    if (is_name && is_text) {
        return item->name;
    }
    if (is_name && role == Qt::DecorationRole) {
        return item->color ? QVariant(swatch(
                                 QColor(item->color->red, item->color->green, item->color->blue),
                                 kSwatchSide))
                           : QVariant();
    }
    if (is_note && (is_text || role == Qt::ToolTipRole)) {
        return item->note;
    }
    return list_.cell(*item, index.column(), role);
}

QVariant DrawnModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation == Qt::Horizontal && role == Qt::DisplayRole &&
        section < list_.columns_.titles.size()) {
        return list_.columns_.titles[section];
    }
    return {};
}

bool DrawnModel::setData(const QModelIndex& index, const QVariant& value, int role)
{
    if (!index.isValid() || role != Qt::EditRole || !(flags(index) & Qt::ItemIsEditable)) {
        return false;
    }
    const std::uint32_t id = idAt(index.row());
    if (index.column() == list_.columns_.name) {
        list_.drawing_.rename(id, value.toString());
    } else {
        list_.drawing_.setNote(id, value.toString());
    }
    return true;
}

void DrawnModel::sort(int column, Qt::SortOrder order)
{
    if (column == sort_column_ && order == sort_order_) {
        return;
    }
    const std::vector<std::uint32_t> selected = list_.selectedIds();
    sort_column_ = column;
    sort_order_ = order;
    beginResetModel();
    sortRows();
    endResetModel();
    list_.restoreSelection(selected);
}

} // namespace marsview
