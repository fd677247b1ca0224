// A map with its edges blended into the maps below it.
#pragma once

#include "core/feather/feather_band.h"

#include <cstddef>
#include <memory>
#include <span>

namespace marsview {

/// The map as it is drawn and touched if its edges are blended over `cells` cells into the maps
/// below it, the uppermost first: the same map, but for the samples of the FeatherBand. All other
/// samples keep their heights to the bit. The map itself if no sample changes, or if it is a
/// preview. Takes 4 bytes for each sample of a map in memory, or 8 where 4 do not hold its values;
/// a map in tiles stays in tiles, and takes those of the band. Not for the GUI thread. Errors:
/// those of FeatherBand, TooLarge if there is no room, and why a tile cannot be read.
Result<std::shared_ptr<const Map>> featheredMap(const BodyTerrain& map,
                                                std::span<const BodyTerrain> below,
                                                std::size_t cells,
                                                JobMonitor& monitor);

} // namespace marsview
