// How a window behaves beyond showing maps.
#pragma once

#include "core/session/project.h"
#include "haptics/sound/sound_player.h"
#include "ui/controllers/device_finder.h"
#include "ui/controllers/map_opener.h"
#include "ui/controllers/preferences.h"
#include "ui/controllers/spacemouse_controller.h"
#include "ui/window/window_messages.h"

#include <filesystem>
#include <functional>

namespace marsview {

struct WindowOptions {
    /// Size, place, docks, recent files and preferences are taken from, and left for, the next
    /// window; or all of it is as on the first day.
    enum class Geometry { Remembered, Fixed } geometry = Geometry::Remembered;
    /// Those of the first day.
    Preferences preferences{};
    /// Where failures are reported besides the signal.
    using Failures = WindowMessages::Failures;
    Failures failures = Failures::AsNotices;
    /// Whether the user is asked before unsaved changes are lost, and about what a crash left
    /// behind.
    enum class Questions { None, Ask } questions = Questions::None;
    /// What View › Scene has at first.
    SceneChoice scene = SceneChoice::Automatic;
    /// Where copies of unsaved projects go; empty for none.
    std::filesystem::path autosave_folder{};
    /// The folder of the maps that come with the program.
    std::filesystem::path bundled_maps{};
    /// How maps are read, and the resources they share unless preferences override them.
    MapOpener opener{};
    /// Of haptic devices; empty for those that come with the program.
    DriverMaker make_drivers{};
    SpaceMouseOptions spacemouse{};
    /// Opens the output of contact sounds.
    std::function<Result<SoundPlayer>()> open_sound = &SoundPlayer::open;

    bool isRemembered() const noexcept { return geometry == Geometry::Remembered; }
};

} // namespace marsview
