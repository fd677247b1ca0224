// Writing rasters whose samples are computed, of any size.
#pragma once

#include "core/base/grid_view.h"
#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/geo/crs.h"
#include "core/geo/geotransform.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace marsview {

enum class RasterBlocks : std::uint8_t { Tiles, Strips };
enum class RasterCompression : std::uint8_t { None, Deflate };

/// An elevation map in whole meters, to be written as GeoTIFF.
struct ComputedRaster {
    std::string path;
    std::size_t columns = 0; // at least 1 × 1
    std::size_t rows = 0;
    std::optional<GeoTransform> transform;
    std::optional<Crs> crs;
    std::string vertical_datum; // empty if unknown
    RasterBlocks blocks = RasterBlocks::Tiles;
    RasterCompression compression = RasterCompression::None;
};

/// Computes the samples from (column, row) on.
using SampleComputer =
    std::function<void(std::size_t column, std::size_t row, GridView<std::int16_t> samples)>;

/// Computes the samples in windows of a tile or less, on all cores, and writes one band of 256 rows
/// while the next is computed: two bands are in memory. An existing file of that name is replaced
/// only when the new one is complete. Refuses rasters that do not fit on the disk; `compute` must
/// not throw.
Status writeComputedRaster(const ComputedRaster& raster,
                           const SampleComputer& compute,
                           JobMonitor& monitor);

} // namespace marsview
