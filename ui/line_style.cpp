#include "ui/line_style.h"

#include "ui/icons.h"

namespace marsview {

LineStyle::LineStyle()
    : QProxyStyle(QStringLiteral("Fusion"))
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
