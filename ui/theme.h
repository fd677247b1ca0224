// Light and dark.
#pragma once

#include "ui/controllers/preferences.h"

#include <QPalette>

namespace marsview {

/// The program's own palettes. Text on any of their backgrounds has a contrast of at least 4.5,
/// disabled text of at least 3.
QPalette lightPalette();
QPalette darkPalette();

/// Gives the whole application a theme, at once. System goes by the palette that the desktop gave
/// the application at its start: Qt 6.4 tells no more.
void applyTheme(Theme theme);

} // namespace marsview
