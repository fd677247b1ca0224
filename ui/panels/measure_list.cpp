#include "ui/panels/measure_list.h"

#include "ui/controllers/measure_controller.h"
#include "ui/text/measure_text.h"
#include "ui/text/sentence.h"

#include <QHeaderView>

#include <cmath>
#include <limits>
#include <utility>

namespace marsview {

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
    horizontalHeader()->setSectionResizeMode(ResultColumn, QHeaderView::ResizeToContents);
}

void MeasureList::setHeightUnit(HeightUnit unit)
{
    unit_ = unit;
    showItems();
}

// The header looks at the cells only when their rows change.
void MeasureList::fitColumns()
{
    horizontalHeader()->setSectionResizeMode(ResultColumn, QHeaderView::ResizeToContents);
}

bool MeasureList::isBefore(const DrawnItem& a, const DrawnItem& b, int column) const
{
    if (column == ResultColumn) {
        const auto key = [this](const DrawnItem& item) {
            const auto& result = controller_.outcome(item.id).result;
            const double figure = result ? measureFigure(*result) : std::nan("");
            return std::pair(static_cast<const MeasureItem&>(item).kind,
                             std::isnan(figure) ? -std::numeric_limits<double>::infinity()
                                                : figure);
        };
        return key(a) < key(b);
    }
    const auto text = [this, column](const DrawnItem& item) {
        return column == NameColumn   ? item.name
               : column == NoteColumn ? item.note
                                      : cell(item, column, Qt::DisplayRole).toString();
    };
    return text(a).localeAwareCompare(text(b)) < 0;
}

QVariant MeasureList::cell(const DrawnItem& drawn, int column, int role) const
{
    const auto& item = static_cast<const MeasureItem&>(drawn);
    if (column == NameColumn && role == Qt::ToolTipRole) {
        return QString(measurementName(item.kind) + QLatin1Char('\n') +
                       locale().toString(localTime(item.time), QLocale::ShortFormat));
    }
    if (column == ResultColumn && (role == Qt::DisplayRole || role == Qt::ToolTipRole)) {
        const auto& result = controller_.outcome(item.id).result;
        if (result && !result->values) {
            //: In place of the figure of a measurement that failed, in a list
            return role == Qt::DisplayRole ? tr("no result")
                                           : asSentence(result->values.error().message);
        }
        return result && role == Qt::DisplayRole ? measureSummary(*result, unit_) : QVariant();
    }
    if (column == LayerColumn && (role == Qt::DisplayRole || role == Qt::ToolTipRole)) {
        const Layer* layer = controller_.layerOf(item);
        if (const MissingLayer* missing = controller_.missingLayerOf(item)) {
            const QString name = QString::fromStdString(missing->record.name);
            //: Of a layer of a project: its file cannot be opened
            return missing->problem.empty() ? name : tr("%1 (missing)").arg(isolated(name));
        }
        //: The layer on which a measurement was made
        return layer != nullptr ? QString::fromStdString(layer->name) : tr("removed");
    }
    return {};
}

} // namespace marsview
