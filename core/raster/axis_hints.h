// Axes and body from the metadata of a raster without a CRS.
#pragma once

#include "core/raster/crs_suggestion.h"

#include <string>

class GDALDataset;

namespace marsview {

/// Axes whose units are declared as degrees (netCDF's "degrees_east" and "degrees_north"), and the
/// body: named in a title or description, in the file name, or implied by a well-known elevation
/// product ("ETOPO", "MOLA"). Call on the thread of the dataset.
AxisHints axisHintsOf(GDALDataset& dataset, const std::string& path);

} // namespace marsview
