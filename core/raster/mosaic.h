// A folder of adjoining rasters, such as the tiles that SRTM and MOLA are handed out in, as one.
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

/// Adjoining rasters as one.
struct Mosaic {
    std::string vrt;                // text that GDAL opens as one raster with one band
    RasterInfo info;                // of the whole; its path is the folder
    std::vector<std::string> files; // all that belong to the parts, sorted
    std::vector<MosaicRaster> parts;

    /// Where reading a window of the whole has failed: the message of the part that is to blame,
    /// found by reading each on its own. Empty where all can be read.
    std::string failureIn(const GridWindow& window) const;
};

/// The rasters that lie in the folder itself, not those in folders within it. They have to be of
/// one kind: sample type, unit, scale, CRS, and one grid. Where parts overlap the last by name is
/// seen, its voids excepted; what none covers is void. Other files are passed over, rasters among
/// them with a notice; those that are named like a part and cannot be read are an error: they would
/// leave a hole without a word.
///
/// Opens every raster, on all cores; asked again, only looks whether any file has changed. Any
/// thread. Errors begin with the folder and name the raster that does not fit.
Result<std::shared_ptr<const Mosaic>> mosaicOf(const std::string& path, int band);

} // namespace marsview
