// Maps on top of each other on a body, one of them in tiles.
#pragma once

#include "core/body/layered_mesh.h"
#include "core/body/tiled_body_mesh.h"
#include "core/tiles/tile_cache.h"
#include "tests/core/contact/nested_maps.h"
#include "tests/haptics/terrain/tiled_map.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace marsview::test {

/// The samples of the map in tiles are also in memory, to compare the two.
struct TiledLayers {
    TiledLayers(const NestedMaps& nested, std::size_t index, double exaggeration);

    /// With a terrain of its own.
    std::shared_ptr<const LayeredMesh> over(std::shared_ptr<const TiledTerrain> terrain) const;
    /// The same maps, all in memory, that in tiles with these heights.
    std::shared_ptr<const LayeredMesh>
    inMemory(std::shared_ptr<const FilledHeightfield> heights) const;
    /// What a joined map in tiles has for some tiles: the heights of the terrain, and those of the
    /// samples where they are pinned.
    std::shared_ptr<const FilledHeightfield> felt(const TiledTerrain& terrain) const;
    /// The maps as they are joined, the one in tiles over that terrain.
    std::vector<std::shared_ptr<const BodyMesh>>
    meshesOver(std::shared_ptr<const TiledTerrain> terrain) const;

    const PinnedSamples& pins() const { return *joined->tiledMap()->pins(); }
    const Ellipsoid& ellipsoid() const { return tiled->grid()->ellipsoid(); }

    std::size_t in_tiles;                                           // index of that map
    std::vector<std::shared_ptr<const Georeference>> georeferences; // the uppermost first
    TiledMap map;
    TileCache cache{{.bytes_max = std::size_t{8} << 20, .loader_threads = 1}};
    std::vector<std::shared_ptr<const BodyMesh>> meshes; // null for that in tiles
    std::shared_ptr<const TiledBodyMesh> tiled;
    std::shared_ptr<const LayeredMesh> joined; // as it is shared
};

} // namespace marsview::test
