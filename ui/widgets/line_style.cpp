#include "ui/widgets/line_style.h"

#include "ui/widgets/icons.h"

#include <QPainter>
#include <QStyleOptionMenuItem>

namespace marsview {

LineStyle::LineStyle(const QString& base)
    : QProxyStyle(base)
{}

QIcon LineStyle::standardIcon(StandardPixmap which,
                              const QStyleOption* option,
                              const QWidget* widget) const
{
    switch (which) {
    case SP_TitleBarCloseButton:
    case SP_DockWidgetCloseButton:
    case SP_LineEditClearButton:
        return lineIcon(QStringLiteral("close"));
    case SP_TitleBarNormalButton:
        return lineIcon(QStringLiteral("float"));
    case SP_ToolBarHorizontalExtensionButton:
        return lineIcon(QStringLiteral("more"));
    default:
        return QProxyStyle::standardIcon(which, option, widget);
    }
}

void LineStyle::drawControl(ControlElement element,
                            const QStyleOption* option,
                            QPainter* painter,
                            const QWidget* widget) const
{
    const auto* entry = qstyleoption_cast<const QStyleOptionMenuItem*>(option);
    const QStyle::State highlighted = State_Selected | State_Enabled;
    if (element != CE_MenuItem || entry == nullptr || entry->icon.isNull() || entry->checked ||
        (entry->state & highlighted) != highlighted) {
        QProxyStyle::drawControl(element, option, painter, widget);
        return;
    }
    QStyleOptionMenuItem copy(*entry);
    const int side = pixelMetric(PM_SmallIconSize, option, widget);
    copy.icon = QIcon(entry->icon.pixmap(QSize(side, side), painter->device()->devicePixelRatioF(),
                                         QIcon::Selected));
    QProxyStyle::drawControl(element, &copy, painter, widget);
}

int LineStyle::styleHint(StyleHint hint,
                         const QStyleOption* option,
                         const QWidget* widget,
                         QStyleHintReturn* data) const
{
    return hint == SH_DialogButtonBox_ButtonsHaveIcons
               ? 0
               : QProxyStyle::styleHint(hint, option, widget, data);
}

} // namespace marsview
