#include "ui/overlay/explained_part.h"

#include <QHelpEvent>
#include <QToolTip>
#include <QWhatsThis>
#include <QWidget>

namespace marsview {

bool explainAt(const QEvent& event, const QWidget& part, const QString& tooltip)
{
    const bool is_tooltip = event.type() == QEvent::ToolTip && !tooltip.isEmpty();
    if ((!is_tooltip && event.type() != QEvent::WhatsThis) || !part.isVisible()) {
        return false;
    }
    const auto& help = static_cast<const QHelpEvent&>(event);
    if (!part.geometry().contains(help.pos())) {
        return false;
    }
    if (is_tooltip) {
        QToolTip::showText(help.globalPos(), tooltip, part.parentWidget(), part.geometry());
    } else {
        QWhatsThis::showText(help.globalPos(), part.whatsThis(), part.parentWidget());
    }
    return true;
}

} // namespace marsview
