// The preferences of a window: choosing them, and passing them to its parts.
#pragma once

#include "ui/controllers/map_opener.h"
#include "ui/controllers/preferences.h"

#include <QObject>

#include <cstddef>

class QMainWindow;

namespace marsview {

class GeoreferencingPanel;
class GlobeView;
class HapticsController;
class LayersPanel;
class LightPopup;
class MapOverlays;
class MeasureMarks;
class MeasurePanel;
class SessionController;
class StatusReadout;
class StretchControl;
class TerrainView;
struct WindowActions;

/// Knows which part of the window follows which preference. GUI thread; must not outlive its parts.
class PreferenceCommands final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        QMainWindow& window;
        WindowActions& actions;
        SessionController& session;
        TerrainView& view;
        GlobeView& globe;
        MapOverlays& overlays;
        HapticsController& haptics;
        StatusReadout& readout;
        LayersPanel& layers;
        GeoreferencingPanel& georeferencing;
        LightPopup& light;
        MeasurePanel& measure_panel;
        MeasureMarks& measure_marks;
        StretchControl& stretch;
        /// How maps are read unless preferences override it.
        MapOpener opener;
        bool is_remembered = false; // for later windows
    };

    explicit PreferenceCommands(Parts parts);

    const Preferences& preferences() const noexcept { return preferences_; }
    /// Takes effect at once.
    void set(const Preferences& preferences);
    /// Opens the dialog.
    void choose();

private:
    void applyToMaps();

    Parts parts_;
    std::size_t standard_tile_bytes_ = 0;
    Preferences preferences_;
};

} // namespace marsview
