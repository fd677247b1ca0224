// A map that is held in memory and read in tiles, to hold one against the other.
#pragma once

#include "core/levels/tile_heights.h"
#include "core/terrain/filled_heightfield.h"
#include "haptics/terrain/resident_window.h"
#include "tests/support/grid_tile_source.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace marsview::test {

struct TiledMap {
    std::shared_ptr<const FilledHeightfield> filled; // the truth
    std::shared_ptr<GridTileSource> source;
    std::shared_ptr<const TileHeights> heights;

    const TileLayout& layout() const { return heights->layout(); }
    std::shared_ptr<const Tile> tile(const TileId& id) const;
    std::shared_ptr<const Tile> top() const;
    /// A window around a place, with nothing but the coarsest level.
    ResidentWindow window(GridPoint centre, const WindowSides& sides = {}) const;
};

TileId samplesTile(std::size_t level, std::size_t column, std::size_t row);

/// Every tile that a window covers.
std::vector<TileId> tilesOf(const ResidentWindow& window);

TiledMap tiledMap(const Heightfield& heightfield, GridTileSource::Options options = {});

} // namespace marsview::test
