#include "haptics/device/device_lock.h"

#include "core/base/environment.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <fmt/format.h>
#include <fstream>
#include <string>
#include <system_error>
#include <unistd.h>

namespace marsview {
namespace {

namespace fs = std::filesystem;

// "openhaptics:Left Device" and "polhem:/dev/hidraw3" as recognizable file names. Plugins have long
// paths, so the end of the path is kept.
std::string fileNameFor(std::string_view uri)
{
    constexpr std::size_t kShownMax = 100;
    std::string name(uri.size() > kShownMax ? uri.substr(uri.size() - kShownMax) : uri);
    std::replace_if(
        name.begin(), name.end(),
        [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
    return fmt::format("{}-{:016x}.lock", name, std::hash<std::string_view>()(uri));
}

std::string nameOf(long process)
{
    if (process == getpid()) {
        return "this program already";
    }
    std::string name;
    std::getline(std::ifstream(fmt::format("/proc/{}/comm", process)), name);
    return name.empty() ? "another program" : fmt::format("{} (process {})", name, process);
}

} // namespace

fs::path deviceLockFolder()
{
    const fs::path runtime = environmentVariable("XDG_RUNTIME_DIR");
    if (runtime.is_absolute()) {
        return runtime / "marsview" / "devices";
    }
    std::error_code none;
    return fs::temp_directory_path(none) / fmt::format("marsview-{}", getuid()) / "devices";
}

Result<std::optional<FileLock>> lockDevice(std::string_view uri, const fs::path& folder)
{
    std::error_code none;
    fs::create_directories(folder, none);
    const std::string file = (folder / fileNameFor(uri)).string();
    Result<std::optional<FileLock>> lock = FileLock::tryLock(file, FileLock::Kind::Exclusive);
    if (!lock) {
        return std::optional<FileLock>();
    }
    if (!*lock) {
        return Error{ErrorCode::Unreadable, fmt::format("{}: is in use by {}; close it there first",
                                                        uri, nameOf(FileLock::holder(file)))};
    }
    return std::move(*lock);
}

} // namespace marsview
