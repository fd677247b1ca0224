// Light and dark.
#pragma once

#include "ui/controllers/preferences.h"

#include <QPalette>

namespace marsview {

/// The program's own palettes. Text on any of their backgrounds has a contrast of at least 4.5,
/// disabled text of at least 3.
QPalette lightPalette();
QPalette darkPalette();

/// Sets the program's style, unless it or one of the user's choice is set. Call it before the first
/// widget is made: dialogs keep what another style decided, such as icons on their buttons.
void useLineStyle();

/// Applies a theme to the whole application immediately. System uses the desktop's palette at
/// application start, because Qt 6.4 does not report later changes.
void applyTheme(Theme theme);

} // namespace marsview
