// Shows a value in a progress bar without painting at once.
#pragma once

#include <QProgressBar>

namespace marsview {

/// As bar.setValue(), which paints the bar at once and thereby sends the whole window, with the
/// picture of the map, to the screen. This leaves it to the window's next frame.
inline void showValue(QProgressBar& bar, int value)
{
    bar.setUpdatesEnabled(false);
    bar.setValue(value);
    bar.setUpdatesEnabled(true);
}

} // namespace marsview
