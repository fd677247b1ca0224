// A map larger than memory that waits for its tiles: for batch work, whose results must not depend
// on how fast a disk is.
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

/// The heights of FilledHeightfield to the bit, at full resolution, always. A tile that is not at
/// hand is fetched while the height is read. For one thread at a time, and never the servo's: it
/// locks, allocates and reads from disk.
class WaitingTerrain final : public TiledTerrain {
public:
    static constexpr std::size_t kTilesMax = std::size_t{kPlacesASide} * kPlacesASide;

    /// `heights` have the layout of the raster. Holds on to `tiles_max` tiles, 1 to kTilesMax.
    WaitingTerrain(TiledRaster raster,
                   std::shared_ptr<const TileHeights> heights,
                   std::size_t tiles_max = kTilesMax);

    bool isVoid(std::size_t column, std::size_t row) const noexcept override;

    /// Why the first tile that could not be had is missing. From then on heights there are made
    /// up, so what was computed is worth nothing.
    const std::optional<Error>& error() const noexcept { return error_; }
    /// Tiles that were not at hand.
    std::uint64_t fetchCount() const noexcept { return fetch_count_; }

private:
    double sampleElsewhere(std::size_t column, std::size_t row) const noexcept override;
    const Tile* fetch(std::size_t column, std::size_t row) const noexcept;

    TiledRaster raster_;
    std::size_t tiles_max_;
    mutable std::array<std::shared_ptr<const Tile>, kTilesMax> tiles_; // by place
    mutable std::deque<std::size_t> places_; // that are taken, in the order of their taking
    mutable std::vector<TileId> failed_;
    mutable std::optional<Error> error_;
    mutable std::uint64_t fetch_count_ = 0;
};

} // namespace marsview
