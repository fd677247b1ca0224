// Tiles that arrive while they are touched.
#pragma once

#include "haptics/terrain/resident_terrain.h"
#include "tests/haptics/terrain/tiled_map.h"
#include "tests/support/random.h"

#include <memory>
#include <vector>

namespace marsview::test {

/// A window over the middle of a small map, whose tiles are missing and arrive at random.
class Arriving {
public:
    Arriving(Random& random, const TiledMap& map, double rate_m_per_s);

    const std::shared_ptr<ResidentTerrain>& terrain() const { return terrain_; }
    bool isAnyMissing() const { return !missing_.empty(); }
    void arrive(GridPoint hand);
    /// The surface as a model sees it now, as a separate map.
    std::shared_ptr<const FilledHeightfield> felt() const;

private:
    Random& random_;
    const TiledMap& map_;
    GridPoint center_;
    std::unique_ptr<Clipmap> window_;
    std::shared_ptr<ResidentTerrain> terrain_;
    std::vector<TileId> missing_;
};

} // namespace marsview::test
