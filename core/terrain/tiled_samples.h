// The samples of a map that is larger than memory, for every thread but the servo's.
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

/// A map's tiles, the coarsest of them always at hand, so that there is an answer everywhere at
/// once. Any thread.
class TiledSamples {
public:
    /// Reads the tile of the coarsest level.
    static Result<std::shared_ptr<const TiledSamples>> open(const TiledRaster& raster);

    const TileLayout& layout() const noexcept { return raster_.layout(); }
    const TiledRaster& raster() const noexcept { return raster_; }
    const std::shared_ptr<const Tile>& top() const noexcept { return top_; }

    /// Has the tile of a sample loaded soon: somebody looks at its very height. Of those asked for
    /// most recently, a few dozen are loaded and kept.
    void ask(std::size_t column, std::size_t row) const;
    /// As long as anything asked for is on its way.
    bool isLoading() const;

private:
    TiledSamples(const TiledRaster& raster, std::shared_ptr<const Tile> top);

    TiledRaster raster_;
    std::shared_ptr<const Tile> top_;
    mutable std::mutex mutex_;
    mutable std::vector<TileId> asked_; // the last first
    mutable TileWishes wishes_;
};

/// How samples that are not in memory are read.
enum class TileAccess : std::uint8_t {
    Resident, // from the finest coarser level that is there; never waits
    Wait,     // from disk or network: for batch work
};

/// Reads heights of a tiled map, remembering the tiles it came by last. For one thread and a short
/// while, a ray or a node: what it remembers stays in memory, and what arrives meanwhile may pass
/// unseen.
class TileCursor {
public:
    TileCursor(const TiledSamples& samples, const ElevationScale& scale, TileAccess access);

    /// Height of a sample in metres; NaN where void, or where reading failed. Where its own tile is
    /// missing, that of the finest coarser surface that is there. Unchecked: column and row lie on
    /// the map.
    double sample(std::size_t column, std::size_t row) { return heightFrom(0, column, row); }
    /// As above, of sample (column, row), which is one of those that `level` has.
    double vertex(std::size_t level, std::size_t column, std::size_t row)
    {
        return heightFrom(level, column, row);
    }
    /// True as long as every sample came from its own tile.
    bool isExact() const noexcept { return is_exact_; }

private:
    static constexpr std::size_t kSlots = 16;

    struct Slot {
        bool is_known = false;
        TileId id;
        std::shared_ptr<const Tile> tile; // null: not there
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
