// All actions of the window, and its menus.
#pragma once

#include "core/contact/contact_model.h"
#include "core/session/measurement.h"
#include "core/vector/feature.h"
#include "core/view/terrain_look.h"
#include "ui/canvas/tool.h"
#include "ui/panels/layers_panel.h"

#include <QList>
#include <QString>

class QAction;
class QActionGroup;
class QMainWindow;
class QMenu;
class QUndoStack;
class QWidget;

namespace marsview {

/// The actions with their texts, keys and hints, and the menus. The window owns them and connects
/// them to its functions.
struct WindowActions {
    /// Makes actions and menu bar. Keys for moving act while `map` has the focus, those for layers
    /// while their list has it, so that fields keep their arrows and letters.
    WindowActions(QMainWindow& window, QWidget& map, QUndoStack& undo_stack);

    QMenu* file = nullptr;
    QAction* open = nullptr;
    QAction* open_folder = nullptr;
    QAction* open_address = nullptr;
    QAction* open_names = nullptr;
    QAction* open_vector = nullptr;
    QMenu* vector_files = nullptr; // open ones
    QMenu* recent = nullptr;       // filled by RecentFiles
    QMenu* bundled = nullptr;      // filled by FileOpening
    QAction* save_picture = nullptr;
    QAction* cancel_loading = nullptr;
    QAction* stop_preparing = nullptr;
    QAction* quit = nullptr;
    QAction* preferences = nullptr;

    QActionGroup* scenes = nullptr; // data(): the SceneChoice
    QAction* globe = nullptr;       // on or off
    QActionGroup* tools = nullptr;  // data(): the Tool
    QAction* home = nullptr;
    QAction* north = nullptr;
    QAction* go_to_place = nullptr;
    QAction* find_name = nullptr;
    QAction* copy_coordinates = nullptr;
    QMenu* coordinate_format = nullptr; // filled by the window
    QList<QAction*> steps;              // data(): the NavigationStep
    QAction* exaggerate_more = nullptr;
    QAction* exaggerate_less = nullptr;
    QMenu* view_menu = nullptr;
    QMenu* panels = nullptr; // the rest is filled by the docks
    QAction* next_panel = nullptr;
    QAction* previous_panel = nullptr;
    QAction* full_screen = nullptr; // checkable

    LayerActions layer;
    QAction* toggle_visibility = nullptr;
    QMenu* ramps = nullptr;
    QActionGroup* ramp_group = nullptr; // data(): the ramp's name
    QMenu* stretches = nullptr;
    QActionGroup* stretch_group = nullptr; // data(): the StretchKind
    QAction* stretch_to_view = nullptr;
    QAction* edit_stretch = nullptr;
    QMenu* shading = nullptr;
    QActionGroup* shading_group = nullptr; // data(): the ShadingMode
    QAction* contours = nullptr;
    QAction* contour_interval = nullptr;
    QAction* export_contours = nullptr;
    QAction* light = nullptr;
    QAction* override_georeferencing = nullptr;

    QActionGroup* measure_kinds = nullptr; // data(): the MeasurementKind
    QAction* add_point = nullptr;
    QAction* finish_measurement = nullptr;
    QAction* remove_measurement = nullptr;
    QAction* remove_measurements = nullptr; // all
    QMenu* measure = nullptr;               // the window adds the panel

    QActionGroup* annotation_shapes = nullptr; // data(): the FeatureShape
    QAction* add_annotation_point = nullptr;
    QAction* finish_annotation = nullptr;
    QAction* remove_annotations = nullptr; // those that are selected
    QAction* import_annotations = nullptr;
    QAction* export_annotations = nullptr;
    QMenu* annotate = nullptr; // the window adds the panel

    QMenu* contact_models = nullptr;
    QActionGroup* contact_model_group = nullptr; // data(): the ContactModelKind
    QAction* contact_sound = nullptr;            // checkable
    QAction* haptic_devices = nullptr;
    QAction* emergency_stop = nullptr;
    QAction* record_touch = nullptr;
    QAction* replay_touch = nullptr;
    QAction* save_flight = nullptr;

    QAction* guide = nullptr;
    QAction* keys = nullptr;
    QAction* whats_this = nullptr;
    QAction* about = nullptr;

    /// Checks and enables what fits `session`.
    void showSession(const Session& session);
    /// Whether the active layer, if there is one, is in the picture.
    void showStretchToView(bool has_layer, bool is_in_picture) const;
    /// Checks `model`.
    void showContactModel(ContactModelKind model);
    /// Checks `tool`, and with Tool::Measure `kind`.
    void showTool(Tool tool, MeasurementKind kind);
    /// Checks `shape` with Tool::Annotate.
    void showShape(Tool tool, FeatureShape shape);

private:
    void showKind(Tool tool, const QString& kind);
    void makeFileMenu(QMainWindow& window);
    void makeEditMenu(QMainWindow& window, QUndoStack& undo_stack);
    void makeViewMenu(QMainWindow& window, QWidget& map);
    void makeSceneMenu(QMainWindow& window, QMenu& view);
    void makeToolMenu(QMainWindow& window, QMenu& view, QWidget& map);
    void makeMapMenu(QMainWindow& window);
    void makeStretchMenu(QMainWindow& window, QMenu& map);
    void makeMeasureMenu(QMainWindow& window);
    void makeAnnotateMenu(QMainWindow& window);
    void makeLayerMenu(QMainWindow& window);
    void makeHapticsMenu(QMainWindow& window);
    void makeHelpMenu(QMainWindow& window);

    QList<QAction*> for_shown_; // of use only while something is shown
};

/// A property of actions whose texts change: what the list of keys calls them.
inline constexpr const char* kKeyTextProperty = "keyText";

} // namespace marsview
