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

/// For formats of which GDAL reads the missing end of a file as samples, and whose layout it does
/// not tell: classic netCDF, PCIDSK and PNM. `info` has driver, size and sample type. Empty for
/// others, and for headers that cannot be read.
std::optional<PromisedExtent> promisedExtentOf(GDALDataset& dataset, const RasterInfo& info);

} // namespace marsview
