#include "haptics/device/crash_marker.h"

#include "core/base/environment.h"

#include <atomic>
#include <cstdlib>
#include <fmt/format.h>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace marsview {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMarkerEnding = ".loading";

// The process number is written after the lock is held, so a file without one has no meaning.
bool isLeftBehind(const fs::path& file)
{
    std::error_code none;
    return FileLock::holder(file.string()) != 0 && !FileLock::isHeld(file.string()) &&
           fs::exists(file, none);
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
            std::atexit(CrashMarker::clearAtExit);
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

fs::path CrashMarker::defaultFolder()
{
    return userFolder("XDG_STATE_HOME", ".local/state") / "marsview" / "loading";
}

CrashMarker CrashMarker::set(const fs::path& folder, const std::string& what)
{
    std::error_code none;
    fs::create_directories(folder, none);
    Folders::all().add(folder);
    static std::atomic<unsigned> count{0};
    const std::string name =
        fmt::format("{}-{}-{}{}", what, getpid(), count.fetch_add(1), kMarkerEnding);
    return CrashMarker(lockOwn((folder / name).string()));
}

std::optional<std::string> CrashMarker::leftBehind(const fs::path& folder,
                                                   const std::string& beginning)
{
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
        const std::string name = entry.path().stem().string();
        if (name.starts_with(beginning) && entry.path().extension() == kMarkerEnding &&
            isLeftBehind(entry.path())) {
            return name;
        }
    }
    return std::nullopt;
}

void CrashMarker::forget(const fs::path& folder, const std::string& beginning)
{
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
        if (entry.path().filename().string().starts_with(beginning) &&
            entry.path().extension() == kMarkerEnding && !FileLock::isHeld(entry.path().string())) {
            fs::remove(entry.path(), none);
        }
    }
}

void CrashMarker::clearAtExit()
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
            if (entry.path().extension() == kMarkerEnding && name.find(own) != std::string::npos &&
                FileLock::isHeld(entry.path().string())) {
                fs::remove(entry.path(), none);
            }
        }
    }
}

} // namespace marsview
