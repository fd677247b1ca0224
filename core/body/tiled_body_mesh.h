// The triangles of a map in tiles on its body.
#pragma once

#include "core/body/body_locator.h"
#include "core/body/body_mesh.h"

#include <memory>

namespace marsview {

/// What all who touch the map share: each has a mesh over a terrain of its own. Immutable; any
/// thread.
///
///     const auto tiled = TiledBodyMesh::build(grid, heights, exaggeration, monitor);
///     const BodySurface surface((*tiled)->over(terrain));
class TiledBodyMesh {
public:
    /// `heights` are those of the grid's raster, and are multiplied by `exaggeration`, above 0. The
    /// only error is Canceled. At most `leaves_max` (>= 1) nodes are stored. Takes a fraction of a
    /// second and up to 10 MB for a map of any size.
    static Result<std::shared_ptr<const TiledBodyMesh>>
    build(std::shared_ptr<const BodyGrid> grid,
          std::shared_ptr<const TileHeights> heights,
          double exaggeration,
          JobMonitor& monitor,
          std::size_t leaves_max = TiledBodyNodes::kLeavesMax);

    const std::shared_ptr<const BodyGrid>& grid() const noexcept { return grid_; }
    double exaggeration() const noexcept { return shape_.exaggeration(); }
    /// Finds the tiles around a point.
    const std::shared_ptr<const BodyLocator>& locator() const noexcept { return locator_; }

    /// The triangles over a terrain of the map. Where its tiles are in memory, those of the map in
    /// memory to the bit; between pinned samples of the map, always.
    std::shared_ptr<const BodyMesh> over(std::shared_ptr<const TiledTerrain> terrain,
                                         std::shared_ptr<const PinnedSamples> pins = nullptr) const;

private:
    TiledBodyMesh(std::shared_ptr<const BodyGrid> grid,
                  const std::shared_ptr<const TileHeights>& heights,
                  double exaggeration,
                  std::size_t leaves_max);
    Status buildTree(JobMonitor& monitor);

    std::shared_ptr<const BodyGrid> grid_;
    std::shared_ptr<const BodyLocator> locator_;
    BodyMesh shape_; // without a terrain
};

} // namespace marsview
