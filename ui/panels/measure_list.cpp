#include "ui/panels/measure_list.h"

#include "ui/controllers/measure_controller.h"
#include "ui/text/measure_text.h"
#include "ui/widgets/icons.h"

#include <QColorDialog>
#include <QContextMenuEvent>
#include <QHeaderView>
#include <QIcon>
#include <QMenu>
#include <QPixmap>
#include <QScopedValueRollback>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace marsview {
namespace {

constexpr int kSwatchSide = 10;

constexpr int kIdRole = Qt::UserRole;
constexpr int kFigureRole = Qt::UserRole + 1;
constexpr int kKindRole = Qt::UserRole + 2;

// Results sort by what they measure, then by size.
class Row final : public QTreeWidgetItem {
public:
    using QTreeWidgetItem::QTreeWidgetItem;

    bool operator<(const QTreeWidgetItem& other) const override
    {
        const int column = treeWidget()->sortColumn();
        if (column != MeasureList::ResultColumn) {
            return text(column).localeAwareCompare(other.text(column)) < 0;
        }
        const auto key = [](const QTreeWidgetItem& row) {
            return std::pair(row.data(MeasureList::ResultColumn, kKindRole).toInt(),
                             row.data(MeasureList::ResultColumn, kFigureRole).toDouble());
        };
        return key(*this) < key(other);
    }
};

} // namespace

MeasureList::MeasureList(MeasureController& controller, QWidget* parent)
    : QTreeWidget(parent)
    , controller_(controller)
{
    setObjectName(QStringLiteral("measurements"));
    setAccessibleName(tr("Measurements"));
    setRootIsDecorated(false);
    setUniformRowHeights(true);
    setColumnCount(ColumnCount);
    setHeaderLabels({tr("Name"), tr("Result"), tr("Note"), tr("Layer")});
    setEditTriggers(QAbstractItemView::EditKeyPressed);
    // All columns are in sight: arrow keys choose rows and never scroll names away.
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    header()->setMinimumSectionSize(40);
    header()->setSectionResizeMode(QHeaderView::Stretch);
    header()->setSectionResizeMode(ResultColumn, QHeaderView::ResizeToContents);
    header()->setSortIndicatorClearable(true);
    sortByColumn(-1, Qt::AscendingOrder); // as they were made
    setSortingEnabled(true);
    setMinimumWidth(260);
    connect(this, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* row) {
        if (!is_filling_ && row != nullptr) {
            controller_.select(idOf(*row));
        }
    });
    connect(this, &QTreeWidget::itemActivated, this, [this](QTreeWidgetItem* row, int column) {
        if (column == NoteColumn) {
            editItem(row, NoteColumn);
        } else {
            controller_.show(idOf(*row));
        }
    });
    connect(this, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* row, int column) {
        if (!is_filling_) {
            edit(*row, column);
        }
    });
}

void MeasureList::setHeightUnit(HeightUnit unit)
{
    unit_ = unit;
    showItems();
}

std::uint32_t MeasureList::idOf(const QTreeWidgetItem& row)
{
    return row.data(NameColumn, kIdRole).toUInt();
}

void MeasureList::showItems()
{
    const QScopedValueRollback filling(is_filling_, true);
    const MeasureState& state = controller_.state();
    setSortingEnabled(false); // rows stay in their places until all are filled
    while (topLevelItemCount() > static_cast<int>(state.items.size())) {
        delete takeTopLevelItem(topLevelItemCount() - 1);
    }
    QTreeWidgetItem* current = nullptr;
    for (std::size_t i = 0; i < state.items.size(); ++i) {
        QTreeWidgetItem* row = topLevelItem(static_cast<int>(i));
        if (row == nullptr) {
            row = new Row(this);
            row->setFlags(row->flags() | Qt::ItemIsEditable);
        }
        fill(*row, i);
        if (state.items[i].id == state.current) {
            current = row;
        }
    }
    setSortingEnabled(true);
    setCurrentItem(current, std::max(0, currentColumn()));
}

void MeasureList::fill(QTreeWidgetItem& row, std::size_t index)
{
    const MeasureItem& item = controller_.state().items[index];
    const MeasureOutcome& outcome = controller_.outcome(item.id);
    const Layer* layer = controller_.layerOf(item);
    row.setData(NameColumn, kIdRole, item.id);
    row.setText(NameColumn, item.name);
    row.setIcon(NameColumn,
                item.color ? swatch(QColor(item.color->red, item.color->green, item.color->blue),
                                    kSwatchSide)
                           : QIcon());
    row.setToolTip(NameColumn, measurementName(item.kind) + QLatin1Char('\n') +
                                   locale().toString(item.time, QLocale::ShortFormat));
    row.setText(ResultColumn, outcome.result ? measureSummary(*outcome.result, unit_) : QString());
    row.setData(ResultColumn, kKindRole, static_cast<int>(item.kind));
    const double figure = outcome.result ? measureFigure(*outcome.result) : std::nan("");
    row.setData(ResultColumn, kFigureRole,
                std::isnan(figure) ? -std::numeric_limits<double>::infinity() : figure);
    row.setText(NoteColumn, item.note);
    row.setToolTip(NoteColumn, item.note);
    const QString layer_name =
        //: The layer on which a measurement was made
        layer != nullptr ? QString::fromStdString(layer->name) : tr("removed");
    row.setText(LayerColumn, layer_name);
    row.setToolTip(LayerColumn, layer_name);
}

// Only names and notes can be changed: other texts return.
void MeasureList::edit(const QTreeWidgetItem& row, int column)
{
    if (column == NameColumn) {
        controller_.rename(idOf(row), row.text(NameColumn));
    } else if (column == NoteColumn) {
        controller_.setNote(idOf(row), row.text(NoteColumn));
    }
    showItems();
}

void MeasureList::askColor(std::uint32_t id)
{
    const MeasureItem* item = controller_.itemOf(id);
    const Rgb8 color = item != nullptr && item->color ? *item->color : Rgb8{255, 221, 64};
    auto* dialog = new QColorDialog(QColor(color.red, color.green, color.blue), window());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QColorDialog::colorSelected, this, [this, id](const QColor& chosen) {
        controller_.setColor(id, Rgb8{static_cast<std::uint8_t>(chosen.red()),
                                      static_cast<std::uint8_t>(chosen.green()),
                                      static_cast<std::uint8_t>(chosen.blue())});
    });
    dialog->open();
}

void MeasureList::contextMenuEvent(QContextMenuEvent* event)
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
    auto* menu = new QMenu(this);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    connect(menu->addAction(tr("&Go There")), &QAction::triggered, this,
            [this, id] { controller_.show(id); });
    // The row may have moved by then: the item is the current one.
    controller_.select(id);
    connect(menu->addAction(tr("Re&name")), &QAction::triggered, this,
            [this] { editItem(currentItem(), NameColumn); });
    connect(menu->addAction(tr("Edit No&te")), &QAction::triggered, this,
            [this] { editItem(currentItem(), NoteColumn); });
    connect(menu->addAction(tr("&Color…")), &QAction::triggered, this,
            [this, id] { askColor(id); });
    QAction* usual = menu->addAction(tr("&Usual Color"));
    const MeasureItem* item = controller_.itemOf(id);
    usual->setEnabled(item != nullptr && item->color.has_value());
    connect(usual, &QAction::triggered, this,
            [this, id] { controller_.setColor(id, std::nullopt); });
    menu->addSeparator();
    connect(menu->addAction(tr("&Remove")), &QAction::triggered, this,
            [this, id] { controller_.remove(id); });
    menu->popup(place);
}

} // namespace marsview
