// The commands on places: going there, identifying, copying their coordinates, measuring them; and
// the place under the pointer in the status bar.
#pragma once

#include "ui/commands/feature_picker.h"
#include "ui/commands/map_menu.h"
#include "ui/dialogs/go_to_dialog.h"
#include "ui/text/place_facts.h"

#include <QObject>

#include <functional>

class QMainWindow;

namespace marsview {

class GlobeView;
class MainToolBar;
class AnnotationController;
class MapOverlays;
class MeasureController;
class NameSearch;
class PreferenceCommands;
class SessionController;
class StatusReadout;
class TerrainView;
class VectorTools;
struct WindowActions;

/// GUI thread; must not outlive its parts.
class PlaceCommands final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        QMainWindow& window;
        const WindowActions& actions;
        const SessionController& session;
        TerrainView& view;
        GlobeView& globe;
        MapOverlays& overlays;
        StatusReadout& readout;
        MainToolBar& tool_bar;
        NameSearch& names;
        MeasureController& measuring;
        AnnotationController& annotating;
        VectorTools& vector_files;
        const PreferenceCommands& preferences;
    };

    explicit PlaceCommands(const Parts& parts);

    /// Asks for a name or a coordinate.
    void goToPlace();
    /// The same, for a point that is drawn there.
    template <typename Drawing>
    void askPoint(Drawing& drawing);
    /// Focuses the search field, or asks for a name where the toolbar has no room for it.
    void findName();
    /// Puts the position that the status bar shows on the clipboard.
    void copyCoordinates();
    /// The same for a place of the scene's grid.
    void copyCoordinates(GridPoint grid);

    /// The context menu of the map.
    MapMenu* mapMenu() const noexcept { return map_menu_; }
    /// The same of the globe.
    MapMenu* globeMenu() const noexcept { return globe_menu_; }
    /// What was clicked on either.
    FeaturePicker& features() noexcept { return features_; }

private:
    void connectReadout();
    void connectClicks();
    GoToDialog* makeDialog();
    MapMenu::Beginnings beginnings();
    MapMenu::Extras extras();
    MapMenu* makeMenu();
    MapMenu* makeGlobeMenu();
    PlaceFacts factsAt(const MenuPlace& place) const;
    template <typename Drawing>
    static void addPlace(Drawing& drawing, const MenuPlace& place);

    Parts parts_;
    MapMenu* map_menu_ = nullptr;
    MapMenu* globe_menu_ = nullptr;
    FeaturePicker features_;
    GoToEntry last_place_;
};

} // namespace marsview
