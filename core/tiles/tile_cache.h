// The one cache of decoded tiles that view and hand share.
#pragma once

#include "core/base/result.h"
#include "core/tiles/tile.h"
#include "core/tiles/tile_source.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace marsview {

struct TiledRasterState;

/// Who wants a tile. Loaders serve the first kind first.
enum class TileUrgency : std::uint8_t {
    Hand,  // is touched now, or within a moment
    View,  // is in the picture
    Ahead, // may be wanted soon
};

struct TileCacheOptions {
    std::size_t bytes_max = std::size_t{1} << 30; // of decoded tiles that nobody holds on to
    /// Two or more have one beside them that serves the hand alone, so that it never waits for what
    /// others are reading.
    std::size_t loader_threads = 2;
};

/// Counts since the cache was made; bytes_held is of now.
struct TileCacheStatistics {
    std::uint64_t loaded = 0;
    std::uint64_t failed = 0;    // attempts
    std::uint64_t cancelled = 0; // wishes withdrawn before a loader took them
    std::uint64_t evicted = 0;
    std::size_t bytes_held = 0;
};

/// Keeps what was used last within its bound, and loads what is wanted on threads of its own.
/// Tiles in use by others live on however full the cache is. All members are for any thread but
/// the servo's: they lock, briefly, and never while something is read.
class TileCache {
public:
    explicit TileCache(const TileCacheOptions& options);
    /// The loaders go on as long as there is a TiledRaster; the last of both waits for what is
    /// being read.
    ~TileCache();
    TileCache(const TileCache&) = delete;
    TileCache& operator=(const TileCache&) = delete;

    std::size_t bytesMax() const;
    void setBytesMax(std::size_t bytes_max);
    TileCacheStatistics statistics() const;
    /// Forgets every tile, as if the cache had just been made; for measuring from cold.
    void clear();

private:
    friend class TiledRaster;
    friend class TileWishes;
    friend struct TiledRasterState;
    struct Impl;
    struct Loaders;
    std::shared_ptr<Impl> impl_;
    std::shared_ptr<Loaders> loaders_;
};

/// A raster read through a cache. Copies share everything; any thread but the servo's.
class TiledRaster {
public:
    TiledRaster(const TileCache& cache, std::shared_ptr<const TileSource> source);

    const TileLayout& layout() const noexcept { return source_->layout(); }
    const std::string& name() const noexcept { return source_->name(); }

    /// The tile if it is there, which counts as a use; null otherwise. Does not ask for it.
    std::shared_ptr<const Tile> find(const TileId& id) const;
    /// The tile, read on this thread unless it is there or a loader is at it: for batch work.
    Result<std::shared_ptr<const Tile>> get(const TileId& id) const;
    /// Why the last attempt to load the tile failed; nothing where it did not. It is tried again
    /// as long as it is wanted, after growing pauses.
    std::optional<Error> failure(const TileId& id) const;
    /// Grows with every tile of this raster that arrives.
    std::uint64_t generation() const noexcept;

private:
    friend class TileCache;
    friend class TileWishes;
    std::shared_ptr<TileCache::Impl> cache_;
    std::shared_ptr<TileCache::Loaders> loaders_;
    std::shared_ptr<const TileSource> source_;
    std::uint64_t number_ = 0; // of the source in the cache
    std::shared_ptr<TiledRasterState> state_;
};

/// What one part of the program wants of a raster at present. What it no longer wants, and nobody
/// else does, is not loaded. The wishes end with the object.
class TileWishes {
public:
    /// `notify`, which may be empty, is called on a loader's thread after each wanted tile that
    /// arrived or failed. It must not be what lets go of the last TiledRaster: that waits for the
    /// loaders.
    TileWishes(const TiledRaster& raster, TileUrgency urgency, std::function<void()> notify = {});
    /// Returns when no call of `notify` is under way.
    ~TileWishes();
    TileWishes(const TileWishes&) = delete;
    TileWishes& operator=(const TileWishes&) = delete;

    /// Takes the place of what was wanted before; the most urgent first. Tiles that are there
    /// count as used.
    void want(std::span<const TileId> tiles);
    /// Waits until all that is wanted is there or has failed.
    void waitForAll() const;
    /// Of what is wanted, how many are neither there nor failed.
    std::size_t missingCount() const;

private:
    friend class TileCache;
    struct Impl;
    std::shared_ptr<Impl> impl_;
};

} // namespace marsview
