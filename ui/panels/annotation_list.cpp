#include "ui/panels/annotation_list.h"

#include "ui/controllers/annotation_controller.h"
#include "ui/text/annotation_text.h"
#include "ui/text/body_text.h"

#include <QHeaderView>
#include <QMenu>

#include <algorithm>

namespace marsview {

AnnotationList::AnnotationList(AnnotationController& controller, QWidget* parent)
    : DrawnList(controller,
                {.titles = {tr("Name"), tr("Type"), tr("Note"), tr("Body")},
                 .name = NameColumn,
                 .note = NoteColumn},
                parent)
    , controller_(controller)
{
    setObjectName(QStringLiteral("annotations"));
    setAccessibleName(tr("Annotations"));
    horizontalHeader()->setSectionResizeMode(ShapeColumn, QHeaderView::ResizeToContents);
    horizontalHeader()->setSectionResizeMode(BodyColumn, QHeaderView::ResizeToContents);
    connect(&controller_, &AnnotationController::changed, this, &AnnotationList::showItems);
    showItems();
}

QVariant AnnotationList::cell(const DrawnItem& drawn, int column, int role) const
{
    const auto& item = static_cast<const AnnotationItem&>(drawn);
    if (role == Qt::DisplayRole) {
        return column == ShapeColumn ? shapeText(item.shape) : bodyName(item.body.name);
    }
    if (role == Qt::ToolTipRole && column == NameColumn) {
        return locale().toString(localTime(item.time), QLocale::ShortFormat);
    }
    // Bodies that are not in the picture are grayed.
    if (role == Qt::ForegroundRole && !controller_.isShown(item)) {
        return palette().brush(QPalette::Disabled, QPalette::Text);
    }
    return {};
}

bool AnnotationList::isBefore(const DrawnItem& a, const DrawnItem& b, int column) const
{
    const auto text = [this, column](const DrawnItem& item) {
        return column == NameColumn   ? item.name
               : column == NoteColumn ? item.note
                                      : cell(item, column, Qt::DisplayRole).toString();
    };
    return text(a).localeAwareCompare(text(b)) < 0;
}

void AnnotationList::addActions(QMenu& menu, const std::vector<std::uint32_t>& ids)
{
    QMenu* symbols = menu.addMenu(tr("&Symbol"));
    symbols->setEnabled(std::any_of(ids.begin(), ids.end(), [this](std::uint32_t id) {
        const AnnotationItem* item = controller_.itemOf(id);
        return item != nullptr && item->isSingle();
    }));
    const AnnotationItem* current = controller_.current();
    for (const MarkSymbol symbol : kMarkSymbols) {
        QAction* action = symbols->addAction(symbolText(symbol));
        action->setCheckable(true);
        action->setChecked(current != nullptr && current->symbol == symbol);
        connect(action, &QAction::triggered, this,
                [this, ids, symbol] { controller_.setSymbols(ids, symbol); });
    }
}

} // namespace marsview
