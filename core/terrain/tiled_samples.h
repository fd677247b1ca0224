// The samples of a map that is larger than memory, for every thread except the servo thread.
#pragma once

#include "core/base/result.h"
#include "core/raster/raster_info.h"
#include "core/tiles/tile_cache.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace marsview {

/// A map's tiles; the coarsest is always resident, so that every query has an immediate answer. Any
/// thread.
class TiledSamples {
public:
    /// Reads the tile of the coarsest level.
    static Result<std::shared_ptr<const TiledSamples>> open(const TiledRaster& raster);

    const TileLayout& layout() const noexcept { return raster_.layout(); }
    const TiledRaster& raster() const noexcept { return raster_; }
    const std::shared_ptr<const Tile>& top() const noexcept { return top_; }

    /// Requests the tile of a sample whose exact height is needed. A few dozen of the most recently
    /// requested tiles are loaded and kept.
    void ask(std::size_t column, std::size_t row) const;
    /// Whether any request is pending.
    bool isLoading() const;

private:
    TiledSamples(const TiledRaster& raster, std::shared_ptr<const Tile> top);

    TiledRaster raster_;
    std::shared_ptr<const Tile> top_;
    mutable std::mutex mutex_;
    mutable std::vector<TileId> asked_; // most recent first
    mutable TileRequests requests_;
};

/// The treatment of samples that are not in memory.
enum class TileAccess : std::uint8_t {
    Resident, // use the finest resident coarser level; never waits
    Wait,     // read from disk or network: for batch work
};

/// Reads heights of a tiled map and caches the last tiles. For one thread and a short time, such as
/// a ray or a node: cached tiles stay in memory, and tiles that arrive later may be missed.
class TileCursor {
public:
    TileCursor(const TiledSamples& samples, const ElevationScale& scale, TileAccess access);

    /// Height of a sample in meters; NaN if void or if reading failed. If its own tile is missing,
    /// the height of the finest resident coarser surface. Unchecked: column and row lie on the map.
    double sample(std::size_t column, std::size_t row) { return heightFrom(0, column, row); }
    /// As above, for sample (column, row) of `level`.
    double vertex(std::size_t level, std::size_t column, std::size_t row)
    {
        return heightFrom(level, column, row);
    }
    /// True if every sample so far came from its own tile.
    bool isExact() const noexcept { return is_exact_; }

private:
    static constexpr std::size_t kSlots = 16;

    struct Slot {
        bool is_known = false;
        TileId id;
        std::shared_ptr<const Tile> tile; // null: not resident
    };

    const Tile* tileAt(std::size_t level, std::size_t i, std::size_t j);
    double heightFrom(std::size_t level, std::size_t column, std::size_t row);
    bool sampleAt(std::size_t level, std::size_t i, std::size_t j, double& height);
    bool interpolated(std::size_t level, std::size_t column, std::size_t row, double& height);

    const TiledSamples& samples_;
    ElevationScale scale_;
    TileAccess access_;
    std::size_t top_level_;
    bool is_exact_ = true;
    std::array<Slot, kSlots> slots_;
};

} // namespace marsview
