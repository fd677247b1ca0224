#include "haptics/device/load_marker.h"

#include "core/base/environment.h"

#include <fmt/format.h>
#include <functional>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".loading";

std::string nameFor(const fs::path& plugin)
{
    std::error_code none;
    const fs::path canonical = fs::weakly_canonical(plugin, none);
    return fmt::format("{}-{:016x}-{}-{}{}", plugin.stem().string(),
                       std::hash<std::string>()(canonical.string()), fs::file_size(plugin, none),
                       fs::last_write_time(plugin, none).time_since_epoch().count(), kEnding);
}

} // namespace

fs::path LoadMarker::defaultFolder()
{
    return userFolder("XDG_STATE_HOME", ".local/state") / "marsview" / "loading";
}

Result<LoadMarker> LoadMarker::make(const fs::path& folder, const fs::path& plugin)
{
    std::error_code none;
    fs::create_directories(folder, none);
    const std::string marker = (folder / nameFor(plugin)).string();
    // A holder's number is written once the lock is held, so a file without one tells nothing.
    if (FileLock::holder(marker) != 0 && !FileLock::isHeld(marker) && fs::exists(marker, none)) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: the program ended while this plugin was being loaded the "
                                 "last time, so it is left out; replace the plugin, or remove {} "
                                 "to try it again",
                                 plugin.string(), marker)};
    }
    Result<std::optional<FileLock>> lock = FileLock::tryLock(marker, FileLock::Kind::Exclusive);
    return LoadMarker(lock ? std::move(*lock) : std::nullopt);
}

void LoadMarker::forgetFailures(const fs::path& folder)
{
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
        if (entry.path().extension() == kEnding && !FileLock::isHeld(entry.path().string())) {
            fs::remove(entry.path(), none);
        }
    }
}

} // namespace marsview
