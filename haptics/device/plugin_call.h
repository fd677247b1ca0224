// Records which plugin crashed the program, and in which call.
#pragma once

#include "core/base/result.h"
#include "haptics/device/crash_marker.h"

#include <cstdint>
#include <filesystem>

namespace marsview {

/// The plugin function that the program is calling.
enum class PluginCall : std::uint8_t { Load, Enumerate, Open, Run, Close };

/// Marks that the program is inside `plugin`, an existing file, until the marker is destroyed. The
/// file name encodes the plugin's path, size and time, so that another build of the plugin gets
/// another name. Returns Invalid, with the remedy, if an earlier call crashed the program. Any
/// thread.
Result<CrashMarker> markPluginCall(const std::filesystem::path& folder,
                                   const std::filesystem::path& plugin,
                                   PluginCall call);

} // namespace marsview
