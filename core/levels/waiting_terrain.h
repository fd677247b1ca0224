// A map larger than memory that waits for its tiles: for batch work, whose results must not depend
// on the speed of the disk.
#pragma once

#include "core/base/result.h"
#include "core/levels/tiled_terrain.h"
#include "core/tiles/tile_cache.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// The heights of FilledHeightfield to the bit, at full resolution, always. A missing tile is
/// fetched while the height is read. For one thread at a time, never the servo thread: it locks,
/// allocates and reads from disk.
class WaitingTerrain final : public TiledTerrain {
public:
    static constexpr std::size_t kTilesMax = std::size_t{kPlacesASide} * kPlacesASide;

    /// `heights` have the layout of the raster. Keeps `tiles_max` tiles, 1 to kTilesMax.
    WaitingTerrain(TiledRaster raster,
                   std::shared_ptr<const TileHeights> heights,
                   std::size_t tiles_max = kTilesMax);

    bool isVoid(std::size_t column, std::size_t row) const noexcept override;

    /// The error of the first tile that could not be read. From then on its heights are invented,
    /// so the results must be discarded.
    const std::optional<Error>& error() const noexcept { return error_; }
    /// The number of tiles that had to be fetched.
    std::uint64_t fetchCount() const noexcept { return fetch_count_; }

private:
    double sampleElsewhere(std::size_t column, std::size_t row) const noexcept override;
    const Tile* fetch(std::size_t column, std::size_t row) const noexcept;

    TiledRaster raster_;
    std::size_t tiles_max_;
    mutable std::array<std::shared_ptr<const Tile>, kTilesMax> tiles_; // by place
    mutable std::deque<std::size_t> places_; // occupied slots, in the order of occupation
    mutable std::vector<TileId> failed_;
    mutable std::optional<Error> error_;
    mutable std::uint64_t fetch_count_ = 0;
};

} // namespace marsview
