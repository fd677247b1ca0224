// A map in tiles with the samples of a FeatherBand: its tiles, and its analysis.
#pragma once

#include "core/feather/feather_band.h"
#include "core/levels/level_file.h"
#include "core/raster/raster_info.h"
#include "core/raster/sample_type.h"
#include "core/tiles/tile_source.h"

#include <memory>

namespace marsview {

/// The type of samples that holds all values of another type, and values between them.
SampleType floatTypeFor(SampleType type);
/// The raw value of a height, in a type that floatTypeFor() returns.
double rawOf(double height_m, const ElevationScale& scale, SampleType type);

/// The tiles of `own` in floatTypeFor() its type, with the samples of the band at all levels, as
/// levels are nested. Means change by the mean of what their samples change by, where voids count
/// as samples. `scale` is that of the map.
std::shared_ptr<const TileSource> featheredTiles(std::shared_ptr<const TileSource> own,
                                                 std::shared_ptr<const FeatherBand> band,
                                                 const ElevationScale& scale);

/// The analysis of these tiles. Bounds are those of the map's blocks together with their new
/// samples: not the narrowest, but true. Errors are those of the map and of what it is raised by
/// together, which the errors of the sum are not larger than. Means are those of the map. `cells`
/// is that of the band. Some seconds for 16 million samples, on all cores.
MapLevels featheredLevels(const MapLevels& own,
                          const FeatherBand& band,
                          std::size_t cells,
                          const ElevationScale& scale);

} // namespace marsview
