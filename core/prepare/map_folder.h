// The folder of prepared maps: built once from large rasters and kept for later.
#pragma once

#include "core/base/file_lock.h"
#include "core/base/result.h"
#include "core/sources/source_identity.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// A prepared map in the folder, with its other files: the level file and the checkpoint of an
/// interrupted attempt.
struct PreparedMap {
    std::string name;   // of its file, unique in the folder
    std::string path;   // of its GeoTIFF, which may still be unfinished
    std::string source; // the source raster; empty if unknown
    std::uint64_t bytes = 0;
    std::filesystem::file_time_type last_used;
    bool is_in_use = false; // opened or being prepared by a program
};

/// Several programs may use the folder at the same time. Any thread.
class MapFolder {
public:
    /// $MARSVIEW_CACHE_DIR, else $XDG_CACHE_HOME/marsview/maps, else ~/.cache/marsview/maps.
    static std::filesystem::path defaultPath();

    /// Creates the folder if it is missing. If it can be neither created nor written to, the error
    /// says why and which variable to set.
    static Result<MapFolder> open(const std::filesystem::path& folder = defaultPath());

    /// For finding prepared maps: creates nothing and needs no write permission. The folder need
    /// not exist.
    static MapFolder at(const std::filesystem::path& folder);

    const std::filesystem::path& path() const noexcept { return folder_; }

    /// Whether any map was prepared here. Reads the names in the folder only.
    bool hasMaps() const;

    /// Where the prepared form of a raster's band lies or is to be put. The same content gives the
    /// same name wherever the raster lies.
    std::string
    pathFor(const SourceIdentity& source, int band, const std::string& settings = "") const;

    /// Marks a prepared map as used now and prevents its removal while the lock lives. NotFound if
    /// the map does not exist.
    Result<FileLock> use(const std::string& path) const;

    /// Records on disk that a map was found damaged, for the program that opens it next. False if
    /// that cannot be written. Any thread.
    bool noteDamage(const std::string& path, const std::string& what) const;
    /// The recorded damage; empty if none was recorded.
    std::optional<std::string> damage(const std::string& path) const;
    /// Call after the map has been rebuilt.
    void forgetDamage(const std::string& path) const;

    /// The most recently used first.
    Result<std::vector<PreparedMap>> list() const;

    /// Refuses maps that are in use.
    Status remove(const std::string& name) const;

    /// Removes the least recently used maps until all take at most `bytes_max`; those in use are
    /// kept regardless of size. Returns the removed maps.
    Result<std::vector<PreparedMap>> trim(std::uint64_t bytes_max) const;

    /// Removes the least recently used maps until the disk has `bytes` free, but none if removing
    /// all would not suffice. Maps in use and the one at `but_for` are kept. Returns the removed
    /// maps.
    Result<std::vector<PreparedMap>> makeRoom(std::uint64_t bytes,
                                              const std::string& but_for) const;

    /// 100 GB, or a fifth of the disk if that is less.
    std::uint64_t defaultBytesMax() const;

private:
    explicit MapFolder(std::filesystem::path folder)
        : folder_(std::move(folder))
    {}

    std::filesystem::path folder_;
};

} // namespace marsview
