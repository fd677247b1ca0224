// Corrects GDAL's placement of PDS3 products.
#pragma once

#include "core/geo/crs.h"
#include "core/geo/geotransform.h"

#include <cstddef>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

class GDALDataset;

namespace marsview {

/// Whole pixels by which a raster must be shifted to match its label.
struct PixelShift {
    int columns = 0; // positive: eastward for a north-up raster
    int rows = 0;    // positive: southward
    bool isNone() const noexcept { return columns == 0 && rows == 0; }
};

/// Compares the outer corner of the first pixel with the label's MAXIMUM_LATITUDE and
/// WESTERNMOST_LONGITUDE. MOLA and LOLA labels count the projection offset from different pixels,
/// but GDAL 3.6 reads both alike, which shifts MOLA grids by one pixel. Only a difference of one
/// whole pixel in a cylindrical projection is corrected.
///
/// `label` is the PDS3 label as JSON (GDAL's "json:PDS" domain).
PixelShift
pds3PlacementShift(const nlohmann::json& label, const GeoTransform& transform, const Crs& crs);

/// `transform` moved by `shift`.
GeoTransform shifted(const GeoTransform& transform, PixelShift shift);

/// A dataset that has the placement and the metadata of a PDS3 label, but no samples: for products
/// whose samples GDAL does not find through it, or whose radii it misreads. Null if the label has
/// none.
std::shared_ptr<GDALDataset> openPds3Placement(const std::string& label_path);

/// The text of a PDS3 label with its radii (A_AXIS_RADIUS, …) in kilometers, which GDAL 3.6 assumes
/// whatever unit the label gives. Without a unit, values too large for kilometers of any planet are
/// meters. Unchanged if they are in kilometers.
std::string withRadiiInKilometers(const std::string& label);

/// Whether the radii of the PDS3 label in that file are in a unit other than kilometers.
bool hasRadiiInOtherUnits(const std::string& label_path);

} // namespace marsview
