// Reconstructs the terrain of a recording over a tiled map.
#pragma once

#include "core/base/result.h"
#include "core/levels/tile_heights.h"
#include "core/tiles/tile_cache.h"
#include "haptics/terrain/ground_record.h"
#include "haptics/terrain/resident_terrain.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace marsview {

/// Follows the records of a recording: tiles that were missing or blended during the recording are
/// so again, to the bit. Reads tiles from disk; for batch work and one thread at a time.
class RecordedGround {
public:
    /// `heights` have the layout of the raster. Of joined maps, each in tiles has its own: `map` is
    /// its index, from above. Returns the error of reading the coarsest tile.
    static Result<std::shared_ptr<RecordedGround>> make(const TiledRaster& raster,
                                                        std::shared_ptr<const TileHeights> heights,
                                                        std::uint32_t map = 0);

    /// Updates the terrain for contact models, which must not be used during the call; records of
    /// the tiles of other maps change nothing. Invalid if the map has no such tiles; otherwise the
    /// error of reading a tile. After a GroundFelt, notify its part's model that the terrain has
    /// changed.
    Status follow(const GroundRecord& record);

    std::shared_ptr<const TiledTerrain> terrain() const { return terrain_; }

private:
    RecordedGround(const TiledRaster& raster,
                   std::shared_ptr<const TileHeights> heights,
                   std::shared_ptr<const Tile> top,
                   std::uint32_t map);
    Status showWindow();

    TiledRaster raster_;
    std::shared_ptr<const TileHeights> heights_;
    std::shared_ptr<const Tile> top_;
    std::uint32_t map_;
    std::vector<ShownTiles> shown_; // by level
    std::shared_ptr<const Clipmap> window_;
    std::shared_ptr<ResidentTerrain> terrain_;
    ClipmapBlend blend_; // for the next GroundFelt
    bool is_other_window_ = false;
};

} // namespace marsview
