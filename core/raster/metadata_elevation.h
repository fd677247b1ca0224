// Reads scale, offset and unit of elevations from the metadata of a raster.
//
// GDAL takes them from a format's own fields only. Programs that convert products to GeoTIFF often
// write them as metadata, under the names of netCDF or PDS3.
#pragma once

#include "core/raster/raster_info.h"

class GDALDataset;
class GDALRasterBand;

namespace marsview {

/// Applies scale and offset of the metadata to integer samples of a band that declares none itself,
/// and a unit to one without, and adds one notice that names the differences. The band's metadata
/// go before those of the raster. Floating-point samples get a notice only: most are elevations
/// already, with metadata left over from their source. `info` is as GDAL reads the band.
void applyMetadata(GDALDataset& dataset, GDALRasterBand& band, RasterInfo& info);

} // namespace marsview
