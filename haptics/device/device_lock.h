// One program a device.
#pragma once

#include "core/base/file_lock.h"
#include "core/base/result.h"

#include <filesystem>
#include <optional>
#include <string_view>

namespace marsview {

/// $XDG_RUNTIME_DIR/marsview/devices, else a folder of this user's among the temporary files.
std::filesystem::path deviceLockFolder();

/// Keeps other runs of this program away from the device as long as the lock lives: the system
/// lets several programs open a HID device, and their forces would mix. `uri` names it. Unreadable,
/// with who has it, where somebody else does. No lock, and no error, where the folder cannot be
/// written to.
Result<std::optional<FileLock>>
lockDevice(std::string_view uri, const std::filesystem::path& folder = deviceLockFolder());

} // namespace marsview
