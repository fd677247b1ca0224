// How long a file must be according to its header.
#pragma once

#include "core/raster/raster_info.h"

#include <gdal_priv.h>

#include <cstdint>
#include <optional>
#include <string>

namespace marsview {

struct PromisedExtent {
    std::string path;
    std::int64_t bytes = 0;
};

/// For classic netCDF, PCIDSK and PNM, where GDAL reads samples beyond the end of a file that is
/// cut short. `info` has driver, size and sample type. Empty for other formats, and for headers
/// that cannot be read.
std::optional<PromisedExtent> promisedExtentOf(GDALDataset& dataset, const RasterInfo& info);

} // namespace marsview
