// Maps on top of each other on a body, some of them in tiles.
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

/// A map in tiles whose samples are also in memory, to compare the two.
struct TiledLayerMap {
    std::size_t index; // among all maps
    TiledMap map;
    std::shared_ptr<const TiledBodyMesh> tiled;
};

struct TiledLayers {
    using Terrains = std::vector<std::shared_ptr<const TiledTerrain>>;
    using Heights = std::vector<std::shared_ptr<const FilledHeightfield>>;

    /// `in_tiles`: the indices of those maps, the uppermost first.
    TiledLayers(const NestedMaps& nested,
                const std::vector<std::size_t>& in_tiles,
                double exaggeration);

    /// With terrains of its own, one per map in tiles.
    std::shared_ptr<const LayeredMesh> over(const Terrains& terrains) const;
    /// The same maps, all in memory, those in tiles with these heights.
    std::shared_ptr<const LayeredMesh> inMemory(const Heights& heights) const;
    /// What joined maps in tiles have for some tiles: the heights of the terrains, and those of the
    /// samples where they are pinned.
    Heights felt(const Terrains& terrains) const;
    /// All samples.
    Heights filled() const;
    /// The maps as they are joined, those in tiles over these terrains.
    std::vector<std::shared_ptr<const BodyMesh>> meshesOver(const Terrains& terrains) const;
    /// All tiles of these maps, read as needed.
    Terrains waiting() const;

    const PinnedSamples& pins(std::size_t i) const { return *joined->map(tiles[i].index)->pins(); }
    const Ellipsoid& ellipsoid() const { return joined->ellipsoid(); }

    std::vector<std::shared_ptr<const Georeference>> georeferences; // the uppermost first
    TileCache cache{{.bytes_max = std::size_t{16} << 20, .loader_threads = 1}};
    std::vector<std::shared_ptr<const BodyMesh>> meshes; // null for those in tiles
    std::vector<TiledLayerMap> tiles;
    std::shared_ptr<const LayeredMesh> joined; // as it is shared
};

} // namespace marsview::test
