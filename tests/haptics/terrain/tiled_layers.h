// A fine map in tiles on top of a coarse one in memory, on a body.
#pragma once

#include "core/body/layered_mesh.h"
#include "core/body/tiled_body_mesh.h"
#include "core/tiles/tile_cache.h"
#include "tests/core/contact/body_maps.h"
#include "tests/core/contact/nested_maps.h"
#include "tests/haptics/terrain/tiled_map.h"

#include <memory>
#include <vector>

namespace marsview::test {

/// The fine map is a fractal; its samples are also in memory, to compare the two.
struct TiledLayers {
    TiledLayers(const BodyMap& fine, const NestedMap& coarse, double exaggeration);

    /// With a terrain of its own.
    std::shared_ptr<const LayeredMesh> over(std::shared_ptr<const TiledTerrain> terrain) const;
    /// The same maps, both in memory, the fine one with these heights.
    std::shared_ptr<const LayeredMesh>
    inMemory(std::shared_ptr<const FilledHeightfield> heights) const;
    /// What a joined map in tiles has for some tiles: the heights of the terrain, and along the
    /// border those of the samples.
    std::shared_ptr<const FilledHeightfield> felt(const TiledTerrain& terrain) const;

    std::vector<std::shared_ptr<const Georeference>> georeferences; // the fine one first
    TiledMap map;
    TileCache cache{{.bytes_max = std::size_t{8} << 20, .loader_threads = 1}};
    std::shared_ptr<const BodyMesh> lower;
    std::shared_ptr<const TiledBodyMesh> tiled;
    std::shared_ptr<const LayeredMesh> joined; // as it is shared
};

} // namespace marsview::test
