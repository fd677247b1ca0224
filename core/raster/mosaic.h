// A mosaic of the adjoining rasters in a folder, such as the tiles of SRTM and MOLA.
#pragma once

#include "core/base/result.h"
#include "core/raster/grid_window.h"
#include "core/raster/raster_info.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace marsview {

/// One raster of a mosaic.
struct MosaicRaster {
    std::string path;
    int band = 1;
    GridWindow place; // in the whole
};

/// Adjoining rasters as one raster.
struct Mosaic {
    std::string vrt;                // XML that GDAL opens as one raster with one band
    RasterInfo info;                // of the whole; its path is the folder
    std::vector<std::string> files; // all files of the parts, sorted
    std::vector<MosaicRaster> parts;

    /// After reading a window of the mosaic has failed: the message of the failing part, found by
    /// reading each part separately. Empty if all can be read.
    std::string failureIn(const GridWindow& window) const;
};

/// The rasters in the folder itself, not in its subfolders. They must have the same sample type,
/// unit, scale, CRS and grid. Where parts overlap, the last by name is used, except for its voids;
/// uncovered samples are void. Other files are skipped, with a notice if they are rasters. Files
/// that are named like a part but cannot be read are skipped too: the first notices name them, each
/// with the reason, because they leave a gap.
///
/// Opens every raster, on all cores; later calls only check whether any file has changed. Any
/// thread. Errors begin with the folder and name the raster that does not fit.
Result<std::shared_ptr<const Mosaic>> mosaicOf(const std::string& path, int band);

} // namespace marsview
