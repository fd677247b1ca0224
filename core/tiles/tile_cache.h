// The cache of decoded tiles that rendering and haptics share.
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

/// The urgency of a tile request. Loaders serve the first kind first.
enum class TileUrgency : std::uint8_t {
    Hand,  // touched now or very soon
    View,  // in the picture
    Ahead, // may be needed soon
};

struct TileCacheOptions {
    std::size_t bytes_max = std::size_t{1} << 30; // limit for decoded tiles not in use elsewhere
    /// With two or more, an extra thread serves only TileUrgency::Hand, so that these requests
    /// never wait for other reads.
    std::size_t loader_threads = 2;
};

/// Counts since construction; bytes_held is the current value.
struct TileCacheStatistics {
    std::uint64_t loaded = 0;
    std::uint64_t failed = 0;   // attempts
    std::uint64_t canceled = 0; // requests canceled before a loader took them
    std::uint64_t evicted = 0;
    std::size_t bytes_held = 0;
};

///     TileCache cache({.bytes_max = std::size_t{1} << 28});
///     const TiledRaster raster(cache, source);
///     TileRequests requests(raster, TileUrgency::View, [] { redraw(); });
///     requests.request(visible_tiles);                  // loads in the background
///     if (const auto tile = raster.find(id)) { draw(*tile); }
///
/// Keeps the most recently used tiles within its limit and loads requested tiles on its own
/// threads. Tiles in use elsewhere stay alive when the cache is full. All members are for any
/// thread except the servo thread: they lock briefly, never during a read.
class TileCache {
public:
    explicit TileCache(const TileCacheOptions& options);
    /// The loaders run as long as a TiledRaster exists; whichever is destroyed last waits for the
    /// current reads.
    ~TileCache();
    TileCache(const TileCache&) = delete;
    TileCache& operator=(const TileCache&) = delete;

    std::size_t bytesMax() const;
    void setBytesMax(std::size_t bytes_max);
    TileCacheStatistics statistics() const;
    /// Evicts every tile, for measuring with a cold cache.
    void clear();

private:
    friend class TiledRaster;
    friend class TileRequests;
    friend struct TiledRasterState;
    struct Impl;
    struct Loaders;
    std::shared_ptr<Impl> impl_;
    std::shared_ptr<Loaders> loaders_;
};

/// A raster read through a cache. Copies share everything; any thread except the servo thread.
class TiledRaster {
public:
    TiledRaster(const TileCache& cache, std::shared_ptr<const TileSource> source);

    /// Another source read through the same cache.
    TiledRaster with(std::shared_ptr<const TileSource> source) const;

    const std::shared_ptr<const TileSource>& source() const noexcept { return source_; }
    const TileLayout& layout() const noexcept { return source_->layout(); }
    const std::string& name() const noexcept { return source_->name(); }

    /// The tile if resident, which counts as a use; null otherwise. Does not request it.
    std::shared_ptr<const Tile> find(const TileId& id) const;
    /// The tile, read on this thread unless it is resident or a loader is reading it: for batch
    /// work.
    Result<std::shared_ptr<const Tile>> get(const TileId& id) const;
    /// Why the last attempt to load the tile failed; empty if it did not. The load is retried at
    /// growing intervals as long as the tile is requested.
    std::optional<Error> failure(const TileId& id) const;
    /// Grows with every tile of this raster that arrives.
    std::uint64_t generation() const noexcept;

private:
    friend class TileCache;
    friend class TileRequests;
    TiledRaster(std::shared_ptr<TileCache::Impl> cache,
                std::shared_ptr<TileCache::Loaders> loaders,
                std::shared_ptr<const TileSource> source);

    std::shared_ptr<TileCache::Impl> cache_;
    std::shared_ptr<TileCache::Loaders> loaders_;
    std::shared_ptr<const TileSource> source_;
    std::uint64_t number_ = 0; // of the source in the cache
    std::shared_ptr<TiledRasterState> state_;
};

/// The current tile requests of one client for a raster. Tiles that no client requests any longer
/// are not loaded. The requests end with the object.
class TileRequests {
public:
    /// `notify`, which may be empty, is called on a loader thread after each requested tile that
    /// arrived or failed. It must not destroy the last TiledRaster, which waits for the loaders.
    TileRequests(const TiledRaster& raster, TileUrgency urgency, std::function<void()> notify = {});
    /// Returns when no call of `notify` is running.
    ~TileRequests();
    TileRequests(const TileRequests&) = delete;
    TileRequests& operator=(const TileRequests&) = delete;

    /// Replaces the previous requests; the most urgent first. Resident tiles count as used.
    void request(std::span<const TileId> tiles);
    /// Waits until every requested tile is resident or has failed.
    void waitForPending() const;
    /// The number of pending requests.
    std::size_t missingCount() const;

private:
    friend class TileCache;
    struct Impl;
    std::shared_ptr<Impl> impl_;
};

} // namespace marsview
