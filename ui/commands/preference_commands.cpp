#include "ui/commands/preference_commands.h"

#include "ui/canvas/terrain_view.h"
#include "ui/commands/stretch_control.h"
#include "ui/controllers/haptics/haptics_controller.h"
#include "ui/controllers/session_controller.h"
#include "ui/dialogs/light_popup.h"
#include "ui/dialogs/preferences_dialog.h"
#include "ui/globe/globe_view.h"
#include "ui/overlay/map_labels.h"
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/measure_marks.h"
#include "ui/panels/georeferencing_panel.h"
#include "ui/panels/layers_panel.h"
#include "ui/panels/measure_panel.h"
#include "ui/window/status_readout.h"
#include "ui/window/theme.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QActionGroup>
#include <QMainWindow>
#include <QSettings>

#include <chrono>
#include <utility>

namespace marsview {

PreferenceCommands::PreferenceCommands(Parts parts)
    : parts_(std::move(parts))
    , standard_tile_bytes_(parts_.opener.resources.tiles->bytesMax())
{
    connect(parts_.actions.preferences, &QAction::triggered, this, &PreferenceCommands::choose);
    connect(parts_.actions.contact_model_group, &QActionGroup::triggered, this,
            [this](QAction* action) {
                Preferences preferences = preferences_;
                preferences.contact_model = static_cast<ContactModelKind>(action->data().toInt());
                set(preferences);
            });
    connect(&parts_.readout, &StatusReadout::formatChosen, this,
            [this](const CoordinateFormat& format) {
                Preferences preferences = preferences_;
                preferences.coordinates = format;
                set(preferences);
            });
}

void PreferenceCommands::choose()
{
    auto* dialog = new PreferencesDialog(
        preferences_,
        {.folder = parts_.opener.resources.folder, .tile_bytes = standard_tile_bytes_},
        &parts_.window);
    const Layer* active = activeLayer(parts_.session.session());
    dialog->setBody(active != nullptr ? active->map->info().body : nullptr);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &PreferencesDialog::preferencesChanged, this, &PreferenceCommands::set);
    dialog->open();
}

void PreferenceCommands::set(const Preferences& preferences)
{
    preferences_ = preferences;
    applyTheme(preferences.theme);
    parts_.readout.setFormat(preferences.coordinates);
    parts_.readout.setHeightUnit(preferences.height_unit);
    parts_.layers.setHeightUnit(preferences.height_unit);
    parts_.georeferencing.setHeightUnit(preferences.height_unit);
    parts_.overlays.setHeightUnit(preferences.height_unit);
    parts_.overlays.labels()->setCoordinateFormat(preferences.coordinates);
    parts_.stretch.setHeightUnit(preferences.height_unit);
    parts_.measure_marks.setHeightUnit(preferences.height_unit);
    parts_.measure_panel.setHeightUnit(preferences.height_unit);
    parts_.measure_panel.setCoordinateFormat(preferences.coordinates);
    parts_.georeferencing.setCoordinateFormat(preferences.coordinates);
    parts_.light.setCoordinateFormat(preferences.coordinates);
    const std::chrono::milliseconds frame_target(1000 / preferences.frames_per_s);
    parts_.view.setAntialiasing(preferences.has_antialiasing);
    parts_.globe.setAntialiasing(preferences.has_antialiasing);
    parts_.view.setFrameTarget(frame_target);
    parts_.globe.setFrameTarget(frame_target);
    parts_.view.setContactModel(preferences.contact_model);
    parts_.globe.setContactModel(preferences.contact_model);
    parts_.haptics.setContactModel(preferences.contact_model);
    applyToMaps();
    parts_.actions.showContactModel(preferences.contact_model);
    if (parts_.is_remembered) {
        QSettings settings;
        save(preferences, settings);
    }
}

void PreferenceCommands::applyToMaps()
{
    MapOpener opener = parts_.opener;
    opener.resources = resourcesFor(opener.resources, preferences_);
    opener.resources.tiles->setBytesMax(
        preferences_.tile_memory_mb > 0 && !qEnvironmentVariableIsSet("MARSVIEW_CACHE_MB")
            ? static_cast<std::size_t>(preferences_.tile_memory_mb) << 20
            : standard_tile_bytes_);
    const auto& fetched = opener.resources.fetched_tiles;
    if (fetched && !opener.resources.folder.empty()) {
        fetched->setFolder(fetchedTilesFolder(opener.resources.folder));
        fetched->setBytesMax(fetchedBytesMax(preferences_));
    }
    parts_.session.setOpener(opener);
}

} // namespace marsview
