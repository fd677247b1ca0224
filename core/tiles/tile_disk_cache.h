// A cache of tiles on disk, so that tiles from a server are fetched only once. Own code because
// GDAL keeps ranges in memory only, and in a database one damaged page could cost all tiles.
#pragma once

#include "core/base/result.h"
#include "core/tiles/tile_source.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace marsview {

/// The default size limit.
inline constexpr std::uint64_t kFetchedBytesMax = 4'000'000'000;

struct TileDiskCacheOptions {
    std::string folder; // created when the first tile is written
    std::uint64_t bytes_max = kFetchedBytesMax;
};

/// Counts since construction.
struct TileDiskCacheStatistics {
    std::uint64_t found = 0;   // tiles read from disk
    std::uint64_t missed = 0;  // tiles not on disk
    std::uint64_t damaged = 0; // of these, tiles whose damaged file was removed
    std::uint64_t written = 0;
    std::uint64_t removed = 0; // to stay within the limit
};

/// A folder of tiles of any number of rasters, with least-recently-used eviction. Programs may
/// share it: files appear complete or not at all, and may vanish at any time. Each writing program
/// exceeds the limit by at most a sixteenth. A write failure is not an error: tiles are then not
/// cached. Any thread except the servo thread.
class TileDiskCache {
public:
    explicit TileDiskCache(const TileDiskCacheOptions& options);
    ~TileDiskCache();
    TileDiskCache(const TileDiskCache&) = delete;
    TileDiskCache& operator=(const TileDiskCache&) = delete;

    std::string folder() const;
    /// Sets the folder for reading and writing tiles; tiles in the previous folder stay there.
    void setFolder(const std::string& folder);
    std::uint64_t bytesMax() const;
    /// Takes effect when the next tile is written.
    void setBytesMax(std::uint64_t bytes_max);

    TileDiskCacheStatistics statistics() const;
    /// Why tiles cannot be cached, as a sentence for the user; empty while they can.
    std::optional<std::string> trouble() const;

private:
    friend class DiskCachedReader;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// The number and size of the tiles in a folder, from any program.
struct KeptTiles {
    std::uint64_t count = 0;
    std::uint64_t bytes = 0;
};

/// Zero if the folder does not exist. Visits every file: not for the GUI thread.
KeptTiles keptTilesIn(const std::string& folder);
/// Removes all tiles from a folder, and nothing else; programs that use it fetch them again. Not
/// for the GUI thread.
Status removeKeptTiles(const std::string& folder);

/// `source` with a disk cache. Its readers open those of `source` only when a tile is not on disk.
///
/// `key` identifies the source and its version: address, version, band, nodata. The layout is added
/// to it.
std::shared_ptr<const TileSource> cachedOnDisk(std::shared_ptr<const TileSource> source,
                                               std::shared_ptr<TileDiskCache> cache,
                                               const std::string& key);

} // namespace marsview
