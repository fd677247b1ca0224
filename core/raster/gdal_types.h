// Our sample types and GDAL's.
#pragma once

#include "core/base/result.h"
#include "core/raster/sample_grid.h"

#include <gdal.h>

#include <cstddef>
#include <optional>

class GDALRasterBand;

namespace marsview {

/// Before GDAL 3.7, signed bytes are bytes with the metadata item PIXELTYPE.
GDALDataType gdalTypeOf(SampleType type);

/// Empty for complex numbers.
std::optional<SampleType> sampleTypeOf(GDALRasterBand& band);

/// TooLarge if no map has so many samples; Unreadable if there are none. The message has no path.
Status checkMapSize(std::size_t columns, std::size_t rows);

} // namespace marsview
