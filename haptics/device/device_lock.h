// Locks that keep a device to one program.
#pragma once

#include "core/base/file_lock.h"
#include "core/base/result.h"

#include <filesystem>
#include <optional>
#include <string_view>

namespace marsview {

/// $XDG_RUNTIME_DIR/marsview/devices, else a per-user folder among the temporary files.
std::filesystem::path deviceLockFolder();

/// Keeps other runs of this program away from the device while the lock exists: the system lets
/// several programs open a HID device, and their forces would mix. `uri` names the device. Returns
/// Unreadable, naming the owner, if another program holds the lock; no lock and no error if the
/// folder is not writable.
Result<std::optional<FileLock>>
lockDevice(std::string_view uri, const std::filesystem::path& folder = deviceLockFolder());

} // namespace marsview
