// The rows of a table of drawn items.
#pragma once

#include "ui/panels/drawn_list.h"

#include <QAbstractTableModel>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// Holds the numbers of the items in the order of the rows, and nothing else of them: a change
/// takes as long as what it changes. GUI thread.
class DrawnModel final : public QAbstractTableModel {
    Q_OBJECT

public:
    /// Part of `list`.
    explicit DrawnModel(DrawnList& list);

    /// Follows the items.
    void follow();
    std::uint32_t idAt(int row) const { return rows_[static_cast<std::size_t>(row)]; }
    /// Empty if there is no such row.
    std::optional<int> rowOf(std::uint32_t id) const;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;
    /// -1: in the order in which the items were made.
    void sort(int column, Qt::SortOrder order) override;

private:
    const DrawnItem* itemAt(int row) const;
    bool isBefore(std::uint32_t a, std::uint32_t b) const;
    void sortRows();
    void insert(std::uint32_t id);
    void remove(std::uint32_t id);

    DrawnList& list_;
    std::vector<std::uint32_t> rows_;
    std::shared_ptr<const void> known_; // items that the rows are of
    int sort_column_ = -1;
    Qt::SortOrder sort_order_ = Qt::AscendingOrder;
};

} // namespace marsview
