#include "haptics/device/load_marker.h"

#include "core/base/environment.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <fmt/format.h>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".loading";

struct Call {
    std::string_view name;  // part of the file name
    std::string_view doing; // "while it was ..."
};

// In the enumeration's order.
constexpr std::array kCalls{Call{"load", "being loaded"}, Call{"enumerate", "listing its devices"},
                            Call{"open", "opening a device"}, Call{"run", "running a device"},
                            Call{"close", "closing a device"}};

std::string stemFor(const fs::path& plugin)
{
    std::error_code none;
    const fs::path canonical = fs::weakly_canonical(plugin, none);
    return fmt::format("{}-{:016x}-{}-{}.", plugin.stem().string(),
                       std::hash<std::string>()(canonical.string()), fs::file_size(plugin, none),
                       fs::last_write_time(plugin, none).time_since_epoch().count());
}

// The process number is written after the lock is held, so a file without one has no meaning.
bool isLeftBehind(const fs::path& file)
{
    std::error_code none;
    return FileLock::holder(file.string()) != 0 && !FileLock::isHeld(file.string()) &&
           fs::exists(file, none);
}

// The name of the file that an earlier call left behind; empty if there is none.
std::string leftBehind(const fs::path& folder, const std::string& stem)
{
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
        std::string name = entry.path().filename().string();
        if (name.starts_with(stem) && entry.path().extension() == kEnding &&
            isLeftBehind(entry.path())) {
            return name;
        }
    }
    return {};
}

std::string_view doingIn(std::string_view name_after_stem)
{
    for (const Call& call : kCalls) {
        if (name_after_stem.starts_with(call.name)) {
            return call.doing;
        }
    }
    return kCalls.front().doing;
}

// A program that checks whether a marker is held locks it for a moment, so even an own file may be
// locked briefly.
std::optional<FileLock> lockOwn(const std::string& file)
{
    constexpr int kTriesMax = 100;
    for (int i = 0; i < kTriesMax; ++i) {
        Result<std::optional<FileLock>> lock = FileLock::tryLock(file, FileLock::Kind::Exclusive);
        if (!lock) {
            return std::nullopt;
        }
        if (*lock) {
            return std::move(*lock);
        }
        std::this_thread::yield();
    }
    return std::nullopt;
}

// Calls that return late may make markers while the program exits, so this is never destroyed.
class Folders {
public:
    static Folders& all()
    {
        static auto* const folders = new Folders; // NOLINT(cppcoreguidelines-owning-memory)
        return *folders;
    }
    void add(const fs::path& folder)
    {
        const std::lock_guard lock(mutex_);
        if (folders_.empty()) {
            std::atexit(LoadMarker::clearAtExit);
        }
        folders_.insert(folder);
    }
    std::set<fs::path> get()
    {
        const std::lock_guard lock(mutex_);
        return folders_;
    }

private:
    std::mutex mutex_;
    std::set<fs::path> folders_;
};

} // namespace

fs::path LoadMarker::defaultFolder()
{
    return userFolder("XDG_STATE_HOME", ".local/state") / "marsview" / "loading";
}

Result<LoadMarker> LoadMarker::make(const fs::path& folder, const fs::path& plugin, PluginCall call)
{
    std::error_code none;
    fs::create_directories(folder, none);
    const std::string stem = stemFor(plugin);
    if (const std::string left = leftBehind(folder, stem); !left.empty()) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: the program ended while this plugin was {} last time, so the "
                                 "plugin is skipped; replace it, or try it again with "
                                 "marsview-cli devices --retry",
                                 plugin.string(),
                                 doingIn(std::string_view(left).substr(stem.size())))};
    }
    Folders::all().add(folder);
    static std::atomic<unsigned> count{0};
    const std::string name =
        fmt::format("{}{}-{}-{}{}", stem, kCalls.at(static_cast<std::size_t>(call)).name, getpid(),
                    count.fetch_add(1), kEnding);
    return LoadMarker(lockOwn((folder / name).string()));
}

void LoadMarker::clearAtExit()
{
    if (gettid() != getpid()) {
        return;
    }
    const std::string own = fmt::format("-{}-", getpid());
    std::error_code none;
    for (const fs::path& folder : Folders::all().get()) {
        for (const auto& entry : fs::directory_iterator(folder, none)) {
            // The part after the plugin's stem: "load-4711-0.loading". An unlocked one is from an
            // earlier process with the same number.
            const std::string name = entry.path().stem().extension().string();
            if (entry.path().extension() == kEnding && name.find(own) != std::string::npos &&
                FileLock::isHeld(entry.path().string())) {
                fs::remove(entry.path(), none);
            }
        }
    }
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
