#include "haptics/device/plugin_driver.h"

#include "core/base/environment.h"
#include "haptics/device/device_lock.h"
#include "haptics/device/guarded_device.h"
#include "haptics/device/home_option.h"
#include "haptics/device/last_trouble.h"
#include "haptics/device/plugin_call.h"
#include "haptics/device/watched_call.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <iterator>
#include <optional>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLibraryEnding = ".so";
constexpr const char* kFolderVariable = "MARSVIEW_PLUGIN_PATH";

using Library = std::shared_ptr<const PluginLibrary>;

std::string stampOf(const fs::path& file)
{
    std::error_code none;
    return fmt::format("{} {}", fs::file_size(file, none),
                       fs::last_write_time(file, none).time_since_epoch().count());
}

std::vector<fs::path> pluginsIn(const fs::path& folder)
{
    std::vector<fs::path> files;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
        if (entry.path().extension() == kLibraryEnding && entry.is_regular_file(none)) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

struct Address {
    fs::path file;
    std::string id;
};

// A library that hangs while it is loaded holds the loader's lock, which exit() needs too: exit()
// would never return.
void exitWithoutUnloading()
{
    on_exit(
        [](int status, void* /*nothing*/) {
            CrashMarker::clearAtExit();
            std::fflush(nullptr);
            _exit(status);
        },
        nullptr);
}

std::string lastingName(const fs::path& file, const std::string& id)
{
    std::error_code none;
    const std::string canonical = fs::weakly_canonical(file, none).string();
    return id.empty() ? fmt::format("plugin:{}", canonical)
                      : fmt::format("plugin:{}#{}", canonical, id);
}

// A path may contain "#", so an existing file is taken as a whole.
Address split(std::string_view address)
{
    std::error_code none;
    const auto hash = address.rfind('#');
    if (hash == std::string_view::npos || fs::exists(fs::path(address), none)) {
        return {address, {}};
    }
    return {address.substr(0, hash), std::string(address.substr(hash + 1))};
}

} // namespace

std::vector<fs::path> installedPluginFolders(const fs::path& program_folder)
{
    std::error_code none;
    const fs::path prefix = fs::weakly_canonical(program_folder / "..", none);
    const fs::path below = fs::path("marsview") / "plugins";
    std::vector<fs::path> folders;
    const auto take = [&](const fs::path& library_folder) {
        if (fs::is_directory(library_folder / below, none)) {
            folders.push_back(library_folder / below);
        }
    };
    for (const auto& entry : fs::directory_iterator(prefix, none)) {
        if (entry.path().filename().string().starts_with("lib")) {
            take(entry.path());
        }
    }
    for (const auto& entry : fs::directory_iterator(prefix / "lib", none)) {
        take(entry.path());
    }
    std::sort(folders.begin(), folders.end());
    return folders;
}

PluginOptions PluginOptions::standard()
{
    PluginOptions options;
    const std::string chosen = environmentVariable(kFolderVariable);
    for (std::size_t begin = 0; begin < chosen.size();) {
        const std::size_t end = std::min(chosen.find(':', begin), chosen.size());
        if (end > begin) {
            options.folders.emplace_back(chosen.substr(begin, end - begin));
        }
        begin = end + 1;
    }
    options.folders.push_back(userFolder("XDG_DATA_HOME", ".local/share") / "marsview" / "plugins");
    std::error_code none;
    std::vector<fs::path> installed =
        installedPluginFolders(fs::read_symlink("/proc/self/exe", none).parent_path());
    installed.emplace_back(MARSVIEW_PLUGIN_FOLDER);
    for (fs::path& folder : installed) {
        if (std::find(options.folders.begin(), options.folders.end(), folder) ==
            options.folders.end()) {
            options.folders.push_back(std::move(folder));
        }
    }
    options.marker_folder = CrashMarker::defaultFolder();
    options.lock_folder = deviceLockFolder();
    return options;
}

PluginDriver::PluginDriver(PluginOptions options)
    : options_(std::move(options))
{}

Error PluginDriver::hung(const fs::path& file, std::string_view what, std::string_view doing)
{
    Error error{ErrorCode::Unreadable,
                fmt::format("{}: did not return from {} within {:.1f} s; it is skipped "
                            "until the program restarts",
                            what, doing, std::chrono::duration<double>(options_.patience).count())};
    known_.insert_or_assign(file, Known{stampOf(file), error});
    return error;
}

Result<Library> PluginDriver::load(const fs::path& file)
{
    const std::string stamp = stampOf(file);
    if (const auto known = known_.find(file); known != known_.end()) {
        if (known->second.stamp == stamp) {
            return known->second.library;
        }
        known_.erase(known);
    }
    Result<CrashMarker> marker = markPluginCall(options_.marker_folder, file, PluginCall::Load);
    if (!marker) {
        return std::move(marker).error();
    }
    // The thread owns the marker: if it hangs, it keeps the marker until the program ends.
    auto library =
        callWatched(options_.patience,
                    [file, held = std::optional(std::move(*marker))]() mutable -> Result<Library> {
                        Result<PluginLibrary> loaded = PluginLibrary::load(file);
                        held.reset();
                        if (!loaded) {
                            return std::move(loaded).error();
                        }
                        return Library(std::make_shared<const PluginLibrary>(std::move(*loaded)));
                    });
    if (!library) {
        exitWithoutUnloading();
        return hung(file, file.string(), "being loaded");
    }
    known_.insert_or_assign(file, Known{stamp, *library});
    return *library;
}

Result<std::vector<PluginEntry>> PluginDriver::list(const fs::path& file, const Library& library)
{
    Result<CrashMarker> marker =
        markPluginCall(options_.marker_folder, file, PluginCall::Enumerate);
    if (!marker) {
        return std::move(marker).error();
    }
    auto entries = callWatched(options_.patience,
                               [library, held = std::optional(std::move(*marker))]() mutable {
                                   std::vector<PluginEntry> listed = library->enumerate();
                                   held.reset();
                                   return listed;
                               });
    if (!entries) {
        return hung(file, file.string(), "listing its devices");
    }
    return std::move(*entries);
}

// The same name for every spelling of the plugin and the device.
Result<std::string>
PluginDriver::nameOf(const fs::path& file, const Library& library, std::string id)
{
    if (id.empty()) {
        Result<std::vector<PluginEntry>> entries = list(file, library);
        if (!entries) {
            return std::move(entries).error();
        }
        id = entries->empty() ? std::string() : entries->front().id;
    }
    return lastingName(file, id);
}

std::vector<FoundDevice> PluginDriver::devicesOf(const fs::path& file)
{
    const std::string uri = fmt::format("{}:{}", scheme(), file.string());
    const auto refused = [&](const Error& error) {
        return std::vector<FoundDevice>{{uri, file.filename().string(), error.message}};
    };
    const Result<Library> library = load(file);
    if (!library) {
        return refused(library.error());
    }
    const Result<std::vector<PluginEntry>> entries = list(file, *library);
    if (!entries) {
        return refused(entries.error());
    }
    std::vector<FoundDevice> found;
    for (const PluginEntry& entry : *entries) {
        FoundDevice& device = found.emplace_back(
            FoundDevice{entry.id.empty() ? uri : fmt::format("{}#{}", uri, entry.id),
                        entry.name.empty() ? (*library)->name() : entry.name, entry.reason});
        const LastTrouble last(options_.marker_folder, lastingName(file, entry.id));
        const std::string trouble = device.isUsable() ? last.get() : std::string();
        if (!trouble.empty()) {
            device.reason = "last time it was used: " + trouble;
            device.is_reason_past = true;
        }
    }
    if (found.empty()) {
        found.push_back({uri, (*library)->name(), "none of its devices is connected"});
    }
    return found;
}

std::vector<FoundDevice> PluginDriver::find()
{
    std::vector<FoundDevice> all;
    for (const fs::path& folder : options_.folders) {
        for (const fs::path& file : pluginsIn(folder)) {
            for (FoundDevice& device : devicesOf(file)) {
                all.push_back(std::move(device));
            }
        }
    }
    return all;
}

fs::path PluginDriver::fileNamed(const fs::path& name) const
{
    // A bare name is never searched for in the current folder, where anyone may have put a file.
    const std::vector<fs::path> folders =
        name.has_parent_path() ? std::vector<fs::path>{fs::path()} : options_.folders;
    std::error_code none;
    for (const fs::path& folder : folders) {
        for (const char* ending : {"", kLibraryEnding}) {
            fs::path file = folder / name;
            file += ending;
            if (fs::is_regular_file(file, none)) {
                return file;
            }
        }
    }
    return {};
}

std::string PluginDriver::folderNames() const
{
    std::vector<std::string> names;
    for (const fs::path& folder : options_.folders) {
        names.push_back(folder.string());
    }
    return fmt::format("{}", fmt::join(names, " or "));
}

Result<std::unique_ptr<HapticDevice>> PluginDriver::open(std::string_view address)
{
    const std::string uri = fmt::format("{}:{}", scheme(), address);
    const PluginHoming homing = takeHomeOption(address) ? PluginHoming::AtHome : PluginHoming::None;
    const auto [named, id] = split(address);
    const fs::path file = fileNamed(named);
    if (file.empty()) {
        return Error{ErrorCode::NotFound,
                     fmt::format("{}: no such plugin; give its path, or put it into {}", uri,
                                 folderNames())};
    }
    const Result<Library> library = load(file);
    if (!library) {
        return library.error();
    }
    const Result<std::string> name = nameOf(file, *library, id);
    if (!name) {
        return name.error();
    }
    Result<std::optional<FileLock>> lock = std::optional<FileLock>();
    if (!options_.lock_folder.empty()) {
        lock = lockDevice(*name, options_.lock_folder);
    }
    if (!lock) {
        return std::move(lock).error();
    }
    const LastTrouble last(options_.marker_folder, *name);
    Result<CrashMarker> marker = markPluginCall(options_.marker_folder, file, PluginCall::Open);
    if (!marker) {
        return std::move(marker).error();
    }
    using Opened = Result<std::unique_ptr<HapticDevice>>;
    auto device =
        callWatched(options_.patience,
                    [library = *library, id = id, uri, homing,
                     guard = GuardedDevice::Options{.plugin = file,
                                                    .marker_folder = options_.marker_folder,
                                                    .lock = std::move(*lock),
                                                    .last_trouble = last},
                     held = std::optional(std::move(*marker))]() mutable -> Opened {
                        Opened opened = library->open(id, uri, homing);
                        if (opened) {
                            // The new marker is made before the old one is removed: no interval is
                            // left unmarked.
                            Result<CrashMarker> running =
                                markPluginCall(guard.marker_folder, guard.plugin, PluginCall::Run);
                            if (running) {
                                guard.marker.emplace(std::move(*running));
                            }
                            guard.device = std::move(*opened);
                            opened = std::unique_ptr<HapticDevice>(
                                std::make_unique<GuardedDevice>(std::move(guard)));
                        }
                        held.reset();
                        return opened;
                    });
    if (!device) {
        last.set("did not return from being opened");
        return hung(file, uri, "being opened");
    }
    if (!*device) {
        // "plugin:x.so: could not be opened: the cover is open"
        const std::string& said = device->error().message;
        last.set(said.starts_with(uri + ": ") ? said.substr(uri.size() + 2) : said);
    }
    return std::move(*device);
}

void PluginDriver::forgetFailures()
{
    CrashMarker::forget(options_.marker_folder);
    for (auto known = known_.begin(); known != known_.end();) {
        known = known->second.library ? std::next(known) : known_.erase(known);
    }
}

} // namespace marsview
