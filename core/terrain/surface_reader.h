// Heights of the surface read directly from the file, for rasters of any size.
#pragma once

#include "core/base/result.h"
#include "core/geo/georeference.h"
#include "core/raster/raster_file.h"
#include "core/raster/raster_info.h"
#include "core/tiles/tile_source.h"

#include <cstddef>
#include <memory>
#include <unordered_map>
#include <vector>

namespace marsview {

/// Evaluates the triangulated surface at single positions by reading the cell around each one, so
/// that the first answer costs the same on a map of any size. Same bits as Heightfield::height on
/// the same map in memory. For one thread.
class SurfaceReader {
public:
    /// `info` describes `file`, including overrides. Both must outlive the reader. `tiles`, if any,
    /// are those of the file and are read instead of it; damaged tiles are errors.
    SurfaceReader(RasterFile& file,
                  const RasterInfo& info,
                  const Georeference& georeference,
                  std::shared_ptr<const TileSource> tiles = nullptr);

    /// Height in meters; NaN outside the outermost samples and in voids. An error if reading fails.
    Result<double> height(GridPoint grid);

    /// As above; on a map that wraps around the body, the strip between its last and its first
    /// column is interpolated too. NaN if the map has no geographic coordinates.
    Result<double> height(GeographicPoint geographic);

private:
    // Heights of the samples in a window, row by row.
    Result<std::vector<double>> heightsIn(const GridWindow& window);
    Result<double> heightInTile(std::size_t column, std::size_t row);

    RasterFile& file_;
    const RasterInfo& info_;
    const Georeference& georeference_;
    ElevationScale scale_;
    std::shared_ptr<const TileSource> tiles_;
    std::unique_ptr<TileReader> reader_; // once one is needed
    std::unordered_map<TileId, Tile, TileIdHash> read_;
};

} // namespace marsview
