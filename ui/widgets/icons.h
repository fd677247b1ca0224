// The program's icons, drawn for the palette and the screen they are shown on.
#pragma once

#include <QColor>
#include <QIcon>
#include <QString>

namespace marsview {

/// An icon of resources/icons/line, in the color that text on buttons has in the application's
/// palette when it is painted, enabled or disabled: it follows a change of theme. `name` has no
/// ending; a name without a file is a programming error.
QIcon lineIcon(const QString& name);
/// The same in one color, for what lies over the map.
QIcon lineIcon(const QString& name, const QColor& color);

/// A square of one color, `side` points wide, for a list or a menu.
QIcon swatch(const QColor& color, int side);

/// The icon of the program, for windows and the About box.
QIcon programIcon();

} // namespace marsview
