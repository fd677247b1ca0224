// Tiles kept on disk, so that what was fetched from a server once need not be fetched again.
#pragma once

#include "core/base/result.h"
#include "core/tiles/tile_source.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace marsview {

/// Where nobody says otherwise.
inline constexpr std::uint64_t kFetchedBytesMax = 4'000'000'000;

struct TileDiskCacheOptions {
    std::string folder; // made when the first tile is written
    std::uint64_t bytes_max = kFetchedBytesMax;
};

/// Counts since the object was made.
struct TileDiskCacheStatistics {
    std::uint64_t found = 0;   // tiles read from disk
    std::uint64_t missed = 0;  // tiles that were not there
    std::uint64_t damaged = 0; // of them, those whose file was removed because it was damaged
    std::uint64_t written = 0;
    std::uint64_t removed = 0; // to stay within the bound
};

/// A folder of tiles of any number of rasters, those that were used longest ago given up first.
/// Programs may share it: files appear whole or not at all, and may vanish at any time. The bound
/// is exceeded by at most a sixteenth for each program that writes. What the disk refuses is no
/// error: then nothing is kept. Any thread but the servo's.
class TileDiskCache {
public:
    explicit TileDiskCache(const TileDiskCacheOptions& options);
    ~TileDiskCache();
    TileDiskCache(const TileDiskCache&) = delete;
    TileDiskCache& operator=(const TileDiskCache&) = delete;

    std::string folder() const;
    /// Where tiles are looked for and kept from now on; those that lie elsewhere stay there.
    void setFolder(const std::string& folder);
    std::uint64_t bytesMax() const;
    /// Holds from the next tile on that is written.
    void setBytesMax(std::uint64_t bytes_max);

    TileDiskCacheStatistics statistics() const;
    /// Why tiles are not kept, as a sentence for the user; nothing while they are.
    std::optional<std::string> trouble() const;

private:
    friend class DiskCachedReader;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// What a folder of tiles holds, whoever wrote it.
struct KeptTiles {
    std::uint64_t count = 0;
    std::uint64_t bytes = 0;
};

/// Nothing where there is no such folder. Looks at every file: not for the GUI's thread.
KeptTiles keptTilesIn(const std::string& folder);
/// Removes all tiles from a folder, and nothing else; programs that use it fetch them again. Not
/// for the GUI's thread.
Status removeKeptTiles(const std::string& folder);

/// `source` with a memory on disk. Its readers open those of `source` only when a tile is not
/// there.
///
/// `key` tells the source from any other, and from itself after a change: address, version, band,
/// nodata. The layout is added to it.
std::shared_ptr<const TileSource> cachedOnDisk(std::shared_ptr<const TileSource> source,
                                               std::shared_ptr<TileDiskCache> cache,
                                               const std::string& key);

} // namespace marsview
