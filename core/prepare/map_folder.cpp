#include "core/prepare/map_folder.h"

#include "core/base/deflate.h"
#include "core/base/environment.h"
#include "core/prepare/geotiff_skeleton.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <span>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kBytesMax = 100'000'000'000;
constexpr std::uint64_t kDiskShare = 5;
constexpr const char* kMapEnding = ".map.tif"; // no other file in the folder has it in its name
constexpr const char* kUseEnding = ".use";     // its modification time is the last use
constexpr const char* kWorkEnding = ".lock";   // see writeTiledGeoTiff
constexpr const char* kDamageEnding = ".damaged";

Error folderError(const fs::path& folder, const std::string& why)
{
    return {ErrorCode::Unreadable,
            fmt::format("{}: prepared maps cannot be kept there ({}); set MARSVIEW_CACHE_DIR to a "
                        "folder that is writable",
                        folder.string(), why)};
}

// The readable part of a name: letters and digits of the user's file name.
std::string readableName(const std::string& path)
{
    std::string name;
    for (const char c : fs::path(path).stem().string()) {
        const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-';
        name += is_plain ? c : '_';
    }
    constexpr std::size_t kLengthMax = 60;
    return name.substr(0, kLengthMax);
}

// Locks that keep both files unused.
struct RemovalLocks {
    FileLock use;
    FileLock work;
};

std::optional<RemovalLocks> lockForRemoval(const std::string& path)
{
    Result<std::optional<FileLock>> use =
        FileLock::tryLock(path + kUseEnding, FileLock::Kind::Exclusive);
    if (!use || !*use) {
        return std::nullopt;
    }
    Result<std::optional<FileLock>> work =
        FileLock::tryLock(path + kWorkEnding, FileLock::Kind::Exclusive);
    if (!work || !*work) {
        return std::nullopt;
    }
    return RemovalLocks{std::move(**use), std::move(**work)};
}

// The files of each map by its name.
std::map<std::string, std::vector<fs::path>> filesByMap(const fs::path& folder,
                                                        std::error_code& failure)
{
    std::map<std::string, std::vector<fs::path>> maps;
    for (fs::directory_iterator it(folder, failure), end; !failure && it != end;
         it.increment(failure)) {
        const std::string name = it->path().filename().string();
        const std::size_t ending = name.find(kMapEnding);
        std::error_code ignored;
        if (ending != std::string::npos && it->is_regular_file(ignored)) {
            maps[name.substr(0, ending + std::strlen(kMapEnding))].push_back(it->path());
        }
    }
    return maps;
}

bool isMerelyLock(const fs::path& file)
{
    const std::string name = file.string();
    return name.ends_with(kUseEnding) || name.ends_with(kWorkEnding);
}

// A raster that is used in place has only a level file.
bool hasFiles(const std::string& path)
{
    std::error_code failure;
    const auto maps = filesByMap(fs::path(path).parent_path(), failure);
    const auto map = maps.find(fs::path(path).filename().string());
    return map != maps.end() && !std::all_of(map->second.begin(), map->second.end(), isMerelyLock);
}

} // namespace

fs::path MapFolder::defaultPath()
{
    if (const std::string chosen = environmentVariable("MARSVIEW_CACHE_DIR"); !chosen.empty()) {
        return chosen;
    }
    return userFolder("XDG_CACHE_HOME", ".cache") / "marsview" / "maps";
}

Result<MapFolder> MapFolder::open(const fs::path& folder)
{
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure) {
        return folderError(folder, failure.message());
    }
    if (!fs::is_directory(folder, failure)) {
        return folderError(folder, "is not a folder");
    }
    if (access(folder.c_str(), R_OK | W_OK | X_OK) != 0) {
        return folderError(folder, std::strerror(errno)); // NOLINT(concurrency-mt-unsafe)
    }
    return at(folder);
}

MapFolder MapFolder::at(const fs::path& folder)
{
    std::error_code none; // of an empty name, which stays empty
    return MapFolder(fs::absolute(folder, none).lexically_normal());
}

bool MapFolder::hasMaps() const
{
    std::error_code failure;
    return !filesByMap(folder_, failure).empty();
}

std::string
MapFolder::pathFor(const SourceIdentity& source, int band, const std::string& settings) const
{
    // The whole identity: two maps may have the same samples at the positions that the digest
    // covers.
    const std::string all = fmt::format("{} {} {} {} {}", source.bytes, source.modified_s,
                                        source.digest, band, settings);
    const std::uint32_t checksum = crc32Of(std::as_bytes(std::span(all)));
    return (folder_ / fmt::format("{}-{}{:08x}{}", readableName(source.path), source.digest,
                                  checksum, kMapEnding))
        .string();
}

Result<FileLock> MapFolder::use(const std::string& path) const
{
    Result<std::optional<FileLock>> lock =
        FileLock::tryLock(path + kUseEnding, FileLock::Kind::Shared);
    // A program that lists the folder also takes the lock, and releases it at once.
    constexpr int kAttempts = 20;
    for (int attempt = 1; lock && !*lock && attempt < kAttempts; ++attempt) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        lock = FileLock::tryLock(path + kUseEnding, FileLock::Kind::Shared);
    }
    if (!lock) {
        return std::move(lock).error();
    }
    if (!*lock || !hasFiles(path)) {
        if (*lock) {
            *lock = std::nullopt;
            lockForRemoval(path); // also removes the lock file
        }
        return Error{ErrorCode::NotFound, fmt::format("{}: prepared map not found", path)};
    }
    std::error_code failure;
    fs::last_write_time(path + kUseEnding, fs::file_time_type::clock::now(), failure);
    return std::move(**lock);
}

bool MapFolder::noteDamage(const std::string& path, const std::string& what) const
{
    std::ofstream note(path + kDamageEnding, std::ios::trunc);
    note << what << '\n';
    note.close();
    return note.good();
}

std::optional<std::string> MapFolder::damage(const std::string& path) const
{
    std::ifstream note(path + kDamageEnding);
    if (!note) {
        return std::nullopt;
    }
    std::string what;
    std::getline(note, what);
    return what;
}

void MapFolder::forgetDamage(const std::string& path) const
{
    std::error_code ignored;
    fs::remove(path + kDamageEnding, ignored);
}

Result<std::vector<PreparedMap>> MapFolder::list() const
{
    std::error_code failure;
    const auto files_by_map = filesByMap(folder_, failure);
    if (failure) {
        return folderError(folder_, failure.message());
    }
    std::vector<PreparedMap> maps;
    for (const auto& [name, files] : files_by_map) {
        if (std::all_of(files.begin(), files.end(), isMerelyLock)) {
            continue; // left by a killed program while removing a map
        }
        PreparedMap map;
        map.name = name;
        map.path = (folder_ / name).string();
        map.last_used = fs::file_time_type::min();
        for (const fs::path& file : files) {
            std::error_code ignored; // another program may remove it
            const std::uintmax_t bytes = fs::file_size(file, ignored);
            map.bytes += ignored ? 0 : bytes;
            const fs::file_time_type time = fs::last_write_time(file, ignored);
            map.last_used = ignored ? map.last_used : std::max(map.last_used, time);
        }
        map.source = readGeoTiffOrigin(map.path).source;
        if (map.source.empty()) {
            map.source = readGeoTiffOrigin(map.path + ".part").source;
        }
        map.is_in_use =
            FileLock::isHeld(map.path + kUseEnding) || FileLock::isHeld(map.path + kWorkEnding);
        maps.push_back(std::move(map));
    }
    std::sort(maps.begin(), maps.end(), [](const PreparedMap& a, const PreparedMap& b) {
        return std::pair(b.last_used, a.name) < std::pair(a.last_used, b.name);
    });
    return maps;
}

Status MapFolder::remove(const std::string& name) const
{
    std::error_code failure;
    const auto files_by_map = filesByMap(folder_, failure);
    if (failure) {
        return folderError(folder_, failure.message());
    }
    const auto map = files_by_map.find(name);
    if (map == files_by_map.end()) {
        return Error{ErrorCode::NotFound,
                     fmt::format("{}: no prepared map is named \"{}\"", folder_.string(), name)};
    }
    const std::string path = (folder_ / name).string();
    const std::optional<RemovalLocks> locks = lockForRemoval(path);
    if (!locks) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: is in use; close the map first", path)};
    }
    for (const fs::path& file : map->second) {
        if (!isMerelyLock(file) && !fs::remove(file, failure) && failure) {
            return Error{ErrorCode::Unreadable, fmt::format("{}: cannot be removed ({})",
                                                            file.string(), failure.message())};
        }
    }
    return Done{};
}

Result<std::vector<PreparedMap>> MapFolder::trim(std::uint64_t bytes_max) const
{
    Result<std::vector<PreparedMap>> maps = list();
    if (!maps) {
        return maps;
    }
    std::uint64_t bytes = 0;
    for (const PreparedMap& map : *maps) {
        bytes += map.bytes;
    }
    std::vector<PreparedMap> removed;
    for (auto map = maps->rbegin(); map != maps->rend() && bytes > bytes_max; ++map) {
        if (remove(map->name)) {
            bytes -= map->bytes;
            removed.push_back(std::move(*map));
        }
    }
    return removed;
}

Result<std::vector<PreparedMap>> MapFolder::makeRoom(std::uint64_t bytes,
                                                     const std::string& but_for) const
{
    std::error_code failure;
    std::vector<PreparedMap> removed;
    const auto available = [&] {
        const fs::space_info space = fs::space(folder_, failure);
        return failure ? bytes : space.available; // writing reports the error
    };
    if (available() >= bytes) {
        return removed;
    }
    Result<std::vector<PreparedMap>> maps = list();
    if (!maps) {
        return maps;
    }
    std::erase_if(*maps, [&](const PreparedMap& map) {
        return map.is_in_use || fs::path(map.path).filename() == fs::path(but_for).filename();
    });
    std::uint64_t removable = 0;
    for (const PreparedMap& map : *maps) {
        removable += map.bytes;
    }
    if (available() + removable < bytes) {
        return removed;
    }
    for (auto map = maps->rbegin(); map != maps->rend() && available() < bytes; ++map) {
        if (remove(map->name)) {
            removed.push_back(std::move(*map));
        }
    }
    return removed;
}

std::uint64_t MapFolder::defaultBytesMax() const
{
    std::error_code failure;
    const fs::space_info space = fs::space(folder_, failure);
    return failure ? kBytesMax : std::min<std::uint64_t>(kBytesMax, space.capacity / kDiskShare);
}

} // namespace marsview
