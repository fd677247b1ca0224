// What an open GDAL dataset and the label of its product say of a raster.
#pragma once

#include "core/raster/raster_info.h"

#include <gdal_priv.h>

#include <string>

namespace marsview {

/// The names of the first rasters in a dataset without bands; empty if there are none.
std::string listOfSubdatasets(GDALDataset& dataset);

/// Whether the band belongs to a picture: it has a palette, or is one of several color bands.
bool isPicture(GDALDataset& dataset, GDALRasterBand& band);
/// Why band number `band` of a picture is refused, with the band of elevations if there is one.
std::string refusalOfPicture(GDALDataset& dataset, int band);

/// The notice of a band that is read as elevations although it looks like part of a picture: its
/// color is declared, or the raster has three or four bands of bytes, none with a name, unit, scale
/// or offset. Empty otherwise.
std::string noticeOfLikelyPicture(GDALDataset& dataset, GDALRasterBand& band);

struct DatasetOrigin {
    std::string path;  // as the user named it
    std::string label; // of a product whose samples are in a TIFF or JPEG2000; else empty
};

/// Reads nodata, placement and elevation scale of the band into `info`, which has path, driver,
/// size and sample type. The label of a product overrides what GDAL reads from it; whatever is
/// missing or corrected is noted in info.notices.
void describe(GDALDataset& dataset,
              GDALRasterBand& band,
              const DatasetOrigin& origin,
              RasterInfo& info);

} // namespace marsview
