#include "ui/window/action_icons.h"

#include "ui/widgets/icons.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"

#include <QAction>
#include <QActionGroup>
#include <QDockWidget>
#include <QMenu>

#include <utility>

namespace marsview {

void setIcons(const WindowActions& actions)
{
    for (const auto& [action, name] : {
             std::pair{actions.open, "open"},
             std::pair{actions.open_folder, "open-folder"},
             std::pair{actions.open_address, "address"},
             std::pair{actions.open_names, "names"},
             std::pair{actions.open_vector, "open-vector"},
             std::pair{actions.find_name, "find"},
             std::pair{actions.recent->menuAction(), "recent"},
             std::pair{actions.bundled->menuAction(), "globe"},
             std::pair{actions.save_picture, "save-picture"},
             std::pair{actions.cancel_loading, "cancel"},
             std::pair{actions.preferences, "preferences"},
             std::pair{actions.quit, "quit"},
             std::pair{actions.home, "home"},
             std::pair{actions.north, "north"},
             std::pair{actions.globe, "globe"},
             std::pair{actions.go_to_place, "go-to"},
             std::pair{actions.copy_coordinates, "copy"},
             std::pair{actions.exaggerate_more, "exaggerate-more"},
             std::pair{actions.exaggerate_less, "exaggerate-less"},
             std::pair{actions.panels->menuAction(), "layers"},
             std::pair{actions.shading->menuAction(), "shading"},
             std::pair{actions.ramps->menuAction(), "ramp"},
             std::pair{actions.stretches->menuAction(), "stretch"},
             std::pair{actions.stretch_to_view, "stretch"},
             std::pair{actions.light, "light"},
             std::pair{actions.layer.go_to, "go-to-layer"},
             std::pair{actions.layer.prepare, "overviews"},
             std::pair{actions.layer.rename, "rename"},
             std::pair{actions.layer.move_up, "move-up"},
             std::pair{actions.layer.move_down, "move-down"},
             std::pair{actions.layer.remove, "remove"},
             std::pair{actions.override_georeferencing, "georeferencing"},
             std::pair{actions.remove_measurement, "remove"},
             std::pair{actions.remove_annotations, "remove"},
             std::pair{actions.haptic_devices, "haptics"},
             std::pair{actions.record_touch, "record"},
             std::pair{actions.replay_touch, "replay"},
             std::pair{actions.save_flight, "save-log"},
             std::pair{actions.emergency_stop, "stop"},
             std::pair{actions.full_screen, "full-screen"},
             std::pair{actions.keys, "keys"},
             std::pair{actions.whats_this, "whats-this"},
             std::pair{actions.about, "about"},
         }) {
        action->setIcon(lineIcon(QString::fromLatin1(name)));
    }
    for (QAction* action : actions.tools->actions()) {
        for (const ToolInfo& info : toolInfos()) {
            if (action->data().toInt() == static_cast<int>(info.tool)) {
                action->setIcon(lineIcon(QString::fromLatin1(info.icon)));
            }
        }
    }
}

void setIcons(const WindowDocks& docks)
{
    for (const auto& [dock, name] : {
             std::pair{docks.datasets(), "layers"},
             std::pair{docks.views(), "views"},
             std::pair{docks.georeferencing(), "georeferencing"},
             std::pair{docks.haptics(), "haptics"},
             std::pair{docks.measurements(), "measure"},
             std::pair{docks.annotations(), "annotate"},
         }) {
        dock->setWindowIcon(lineIcon(QString::fromLatin1(name)));
    }
}

} // namespace marsview
