// The ground that a recording over a map in tiles felt, again.
#pragma once

#include "core/base/result.h"
#include "core/levels/tile_heights.h"
#include "core/tiles/tile_cache.h"
#include "haptics/terrain/ground_record.h"
#include "haptics/terrain/resident_terrain.h"

#include <memory>
#include <vector>

namespace marsview {

/// Follows the records of a recording: where tiles were missing or blended when it was made, they
/// are so again, to the bit. Reads tiles from disk while it does; for batch work and one thread at
/// a time.
class RecordedGround {
public:
    /// `heights` have the layout of the raster. What the coarsest tile cannot be had for.
    static Result<std::shared_ptr<RecordedGround>> make(const TiledRaster& raster,
                                                        std::shared_ptr<const TileHeights> heights);

    /// For contact models, which are not asked meanwhile. Invalid where the map has no such tiles;
    /// what a tile cannot be had for. After a GroundFelt the model of its part is to be told that
    /// the terrain has changed.
    Status follow(const GroundRecord& record);

    std::shared_ptr<const TiledTerrain> terrain() const { return terrain_; }

private:
    RecordedGround(const TiledRaster& raster,
                   std::shared_ptr<const TileHeights> heights,
                   std::shared_ptr<const Tile> top);
    Status showWindow();

    TiledRaster raster_;
    std::shared_ptr<const TileHeights> heights_;
    std::shared_ptr<const Tile> top_;
    std::vector<ShownTiles> shown_; // by level
    std::shared_ptr<const ResidentWindow> window_;
    std::shared_ptr<ResidentTerrain> terrain_;
    WindowBlend blend_; // of the next GroundFelt
    bool is_other_window_ = false;
};

} // namespace marsview
