// A map both in memory and in tiles, to compare the two.
#pragma once

#include "core/levels/tile_heights.h"
#include "core/terrain/filled_heightfield.h"
#include "haptics/terrain/clipmap.h"
#include "tests/support/grid_tile_source.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace marsview::test {

struct TiledMap {
    std::shared_ptr<const FilledHeightfield> filled; // the reference
    std::shared_ptr<GridTileSource> source;
    std::shared_ptr<const TileHeights> heights;

    const TileLayout& layout() const { return heights->layout(); }
    std::shared_ptr<const Tile> tile(const TileId& id) const;
    std::shared_ptr<const Tile> top() const;
    /// A window around a position, with only the coarsest level.
    Clipmap window(GridPoint center, const WindowSides& sides = {}) const;
};

TileId samplesTile(std::size_t level, std::size_t column, std::size_t row);

/// All tiles that a window covers.
std::vector<TileId> tilesOf(const Clipmap& window);

TiledMap tiledMap(const Heightfield& heightfield, GridTileSource::Options options = {});

} // namespace marsview::test
