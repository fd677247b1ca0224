// The texts of the What's This mode (Shift+F1).
#pragma once

class QWidget;

namespace marsview {

class GlobeOverlays;
class LoadStatus;
class MapOverlays;
class NoticeBar;
class StatusReadout;
class TerrainView;
class WindowDocks;
struct WindowActions;

/// The controls with a text. None is null.
struct ExplainedControls {
    TerrainView* view = nullptr;
    MapOverlays* overlays = nullptr;
    QWidget* globe = nullptr;
    GlobeOverlays* globe_overlays = nullptr;
    NoticeBar* notices = nullptr;
    StatusReadout* readout = nullptr;
    LoadStatus* load_status = nullptr;
    WindowDocks* docks = nullptr;
    const WindowActions* actions = nullptr;
};

/// Gives the main controls their texts.
void explainControls(const ExplainedControls& controls);

} // namespace marsview
