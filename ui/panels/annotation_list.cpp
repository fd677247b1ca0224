#include "ui/panels/annotation_list.h"

#include "ui/controllers/annotation_controller.h"
#include "ui/text/annotation_text.h"
#include "ui/text/body_text.h"

#include <QHeaderView>
#include <QMenu>

#include <algorithm>

namespace marsview {
namespace {

constexpr int kShownRole = Qt::UserRole + 1;

} // namespace

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
    header()->setSectionResizeMode(ShapeColumn, QHeaderView::ResizeToContents);
    header()->setSectionResizeMode(BodyColumn, QHeaderView::ResizeToContents);
    connect(&controller_, &AnnotationController::changed, this, &AnnotationList::showItems);
    showItems();
}

void AnnotationList::fill(QTreeWidgetItem& row, const DrawnItem& drawn)
{
    const AnnotationItem& item = *controller_.itemOf(drawn.id);
    row.setToolTip(NameColumn, locale().toString(item.time, QLocale::ShortFormat));
    row.setText(ShapeColumn, shapeText(item.shape));
    // Bodies that are not in the picture are grayed.
    row.setText(BodyColumn, bodyName(item.body.name));
    const bool is_shown = controller_.isShown(item);
    const QPalette::ColorGroup group = is_shown ? QPalette::Active : QPalette::Disabled;
    for (const int column : {NameColumn, ShapeColumn, NoteColumn, BodyColumn}) {
        row.setForeground(column, palette().brush(group, QPalette::Text));
    }
    row.setData(NameColumn, kShownRole, is_shown);
}

bool AnnotationList::isStale(const QTreeWidgetItem& row, const DrawnItem& drawn) const
{
    const AnnotationItem& item = *controller_.itemOf(drawn.id);
    return row.data(NameColumn, kShownRole).toBool() != controller_.isShown(item);
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
