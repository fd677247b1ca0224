#include "ui/canvas/map_keys.h"

#include <QAction>
#include <QKeyEvent>
#include <QWidget>

namespace marsview {

MapKeys::MapKeys(const QWidget& map, QObject* parent)
    : QObject(parent)
    , map_(map)
{}

void MapKeys::addTo(QWidget& list)
{
    list.installEventFilter(this);
}

bool MapKeys::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() != QEvent::KeyPress) {
        return QObject::eventFilter(watched, event);
    }
    const auto& press = static_cast<const QKeyEvent&>(*event);
    const bool is_plain =
        (press.modifiers() & ~(Qt::ShiftModifier | Qt::KeypadModifier)) == Qt::NoModifier;
    const bool is_character =
        press.text().size() == 1 && press.text().front().isPrint() && press.key() != Qt::Key_Space;
    if (is_plain && is_character) {
        const QKeySequence key(press.key());
        for (QAction* action : map_.actions()) {
            if (action->isEnabled() && action->shortcuts().contains(key)) {
                action->trigger();
                return true;
            }
        }
    }
    return QObject::eventFilter(watched, event);
}

} // namespace marsview
