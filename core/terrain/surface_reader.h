// Heights of the surface straight from the file, for rasters of any size.
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
/// the same map held in memory. For one thread.
class SurfaceReader {
public:
    /// `info` describes `file`, overrides included. Both outlive the reader. `tiles`, where there
    /// are any, are the file's, and are read in its place: an error where they are damaged.
    SurfaceReader(RasterFile& file,
                  const RasterInfo& info,
                  const Georeference& georeference,
                  std::shared_ptr<const TileSource> tiles = nullptr);

    /// Height in metres; NaN outside the outermost samples and in voids. An error where reading
    /// fails.
    Result<double> height(GridPoint grid);

    /// As above; on a map that goes once around the body, the strip between its last and its first
    /// column is interpolated too. NaN where the map has no geographic coordinates.
    Result<double> height(GeographicPoint geographic);

private:
    // Of the samples in a window of some samples, row by row.
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
