// Telling damaged tiles of a raster by what was measured of it.
#pragma once

#include "core/raster/raster_info.h"
#include "core/raster/sample_grid.h"
#include "core/raster/tile.h"
#include "core/terrain/min_max_pyramid.h"

namespace marsview {

/// Whether the samples of a tile of kind Samples agree with the bounds of the map, which were made
/// with `scale`: none lies outside; and at level 0, in blocks that lie in the tile with all their
/// sides, the extremes are the bounds themselves. Samples that a damaged tile decodes to hardly
/// ever do. Takes a twentieth of what decoding does.
bool isWithinBounds(const SampleGrid& samples,
                    const TileId& tile,
                    const TileLayout& layout,
                    const MinMaxPyramid& bounds,
                    const ElevationScale& scale);

} // namespace marsview
