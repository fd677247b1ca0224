#include "ui/panels/measure_list.h"

#include "ui/controllers/measure_controller.h"
#include "ui/text/measure_text.h"

#include <QHeaderView>

#include <cmath>
#include <limits>
#include <utility>

namespace marsview {
namespace {

constexpr int kFigureRole = Qt::UserRole + 1;
constexpr int kKindRole = Qt::UserRole + 2;

} // namespace

MeasureList::MeasureList(MeasureController& controller, QWidget* parent)
    : DrawnList(controller,
                {.titles = {tr("Name"), tr("Result"), tr("Note"), tr("Layer")},
                 .name = NameColumn,
                 .note = NoteColumn},
                parent)
    , controller_(controller)
{
    setObjectName(QStringLiteral("measurements"));
    setAccessibleName(tr("Measurements"));
    header()->setSectionResizeMode(ResultColumn, QHeaderView::ResizeToContents);
}

void MeasureList::setHeightUnit(HeightUnit unit)
{
    unit_ = unit;
    showItems();
}

bool MeasureList::isBefore(const QTreeWidgetItem& a, const QTreeWidgetItem& b, int column) const
{
    if (column != ResultColumn) {
        return DrawnList::isBefore(a, b, column);
    }
    const auto key = [](const QTreeWidgetItem& row) {
        return std::pair(row.data(ResultColumn, kKindRole).toInt(),
                         row.data(ResultColumn, kFigureRole).toDouble());
    };
    return key(a) < key(b);
}

void MeasureList::fill(QTreeWidgetItem& row, const DrawnItem& drawn)
{
    const MeasureItem& item = *controller_.itemOf(drawn.id);
    const MeasureOutcome& outcome = controller_.outcome(item.id);
    const Layer* layer = controller_.layerOf(item);
    row.setToolTip(NameColumn, measurementName(item.kind) + QLatin1Char('\n') +
                                   locale().toString(item.time, QLocale::ShortFormat));
    row.setText(ResultColumn, outcome.result ? measureSummary(*outcome.result, unit_) : QString());
    row.setData(ResultColumn, kKindRole, static_cast<int>(item.kind));
    const double figure = outcome.result ? measureFigure(*outcome.result) : std::nan("");
    row.setData(ResultColumn, kFigureRole,
                std::isnan(figure) ? -std::numeric_limits<double>::infinity() : figure);
    const QString layer_name =
        //: The layer on which a measurement was made
        layer != nullptr ? QString::fromStdString(layer->name) : tr("removed");
    row.setText(LayerColumn, layer_name);
    row.setToolTip(LayerColumn, layer_name);
}

} // namespace marsview
