// What one window leaves for the next: its size, its docks, the overlays that are shown.
#pragma once

class QMainWindow;

namespace marsview {

class MapOverlays;
class WindowDocks;

/// Sets the window up as the settings say.
void restoreWindow(QMainWindow& window, WindowDocks& docks, MapOverlays& overlays);
/// Leaves full screen first: the next window does not start in it.
void saveWindow(QMainWindow& window, WindowDocks& docks, const MapOverlays& overlays);
/// Offers the hint for new users until it has been dismissed once.
void offerHintOnce(MapOverlays& overlays);

} // namespace marsview
