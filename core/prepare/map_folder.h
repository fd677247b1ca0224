// The folder of prepared maps: made once from rasters that are too large, kept for the next time.
#pragma once

#include "core/base/file_lock.h"
#include "core/base/result.h"
#include "core/raster/source_identity.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// A prepared map in the folder, with all files that belong to it: levels, notes of an attempt that
/// was stopped.
struct PreparedMap {
    std::string name;   // of its file, unique in the folder
    std::string path;   // of its GeoTIFF, which may still be unfinished
    std::string source; // what it was made from; empty where that is not known
    std::uint64_t bytes = 0;
    std::filesystem::file_time_type last_used;
    bool is_in_use = false; // opened or being prepared by some program
};

/// Several programs may use the folder at a time. Any thread.
class MapFolder {
public:
    /// $MARSVIEW_CACHE_DIR, else $XDG_CACHE_HOME/marsview/maps, else ~/.cache/marsview/maps.
    static std::filesystem::path defaultPath();

    /// Makes the folder where it is missing. Says what is wrong where it can be neither made nor
    /// written to, and what to set instead.
    static Result<MapFolder> open(const std::filesystem::path& folder = defaultPath());

    /// To look for what was prepared: makes nothing, and asks for no permission to write. It may
    /// not even be there.
    static MapFolder at(const std::filesystem::path& folder);

    const std::filesystem::path& path() const noexcept { return folder_; }

    /// Whether any map was prepared here. Reads the names in the folder only.
    bool hasMaps() const;

    /// Where the prepared form of a raster's band lies or is to be put. The same content gives the
    /// same name wherever the raster lies.
    std::string
    pathFor(const SourceIdentity& source, int band, const std::string& settings = "") const;

    /// Marks a prepared map as used now, and keeps it from being removed as long as the lock lives.
    /// NotFound where there is no such map.
    Result<FileLock> use(const std::string& path) const;

    /// Notes on the disk that a map was found damaged, for whoever opens it next. False where that
    /// cannot be written. Any thread.
    bool noteDamage(const std::string& path, const std::string& what) const;
    /// What was found damaged; nothing where nobody noted anything.
    std::optional<std::string> damage(const std::string& path) const;
    /// When it has been made anew.
    void forgetDamage(const std::string& path) const;

    /// The most recently used first.
    Result<std::vector<PreparedMap>> list() const;

    /// Refuses maps that are in use.
    Status remove(const std::string& name) const;

    /// Removes the least recently used maps until all take at most `bytes_max`; those in use stay
    /// whatever they take. Returns what was removed.
    Result<std::vector<PreparedMap>> trim(std::uint64_t bytes_max) const;

    /// Removes the least recently used maps until the disk has `bytes` to spare, but none where all
    /// of them would not make room enough. Those in use stay, and so does the one at `but_for`.
    /// Returns what was removed.
    Result<std::vector<PreparedMap>> makeRoom(std::uint64_t bytes,
                                              const std::string& but_for) const;

    /// 100 GB, or a fifth of the disk where that is less.
    std::uint64_t defaultBytesMax() const;

private:
    explicit MapFolder(std::filesystem::path folder)
        : folder_(std::move(folder))
    {}

    std::filesystem::path folder_;
};

} // namespace marsview
