// What metadata says of axes and body where a raster has no CRS.
#pragma once

#include "core/raster/crs_suggestion.h"

#include <string>

class GDALDataset;

namespace marsview {

/// Axes whose units are declared as degrees (netCDF's "degrees_east" and "degrees_north"), and the
/// body: named in a title or description, by the name of the file, or by that of a well-known
/// collection of elevations ("ETOPO", "MOLA"). Called on the thread of the dataset.
AxisHints axisHintsOf(GDALDataset& dataset, const std::string& path);

} // namespace marsview
