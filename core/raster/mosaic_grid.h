// The common grid of adjoining rasters.
#pragma once

#include "core/base/result.h"
#include "core/geo/geotransform.h"
#include "core/raster/grid_window.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// The grid of one raster of a mosaic.
struct MosaicPart {
    std::string name; // for messages
    GeoTransform transform;
    GridSize size;
};

/// The grid of a mosaic: the smallest rectangle with all parts in it.
struct MosaicGrid {
    GeoTransform transform;
    GridSize size;
    std::vector<GridWindow> places; // of the parts, in their order
    double covered = 1.0;           // fraction of the samples that a part covers, (0, 1]
};

/// Lays out the parts; at least one. Neighbors may share columns and rows, or leave gaps. If `turn`
/// is the map's length around the body and a whole number of samples, parts on both sides of the
/// antimeridian are placed side by side. Invalid if the parts are rotated, or their samples do not
/// share a grid to a twentieth of a pixel: the message names the first part that does not fit and
/// the part it was compared with.
Result<MosaicGrid> layOutMosaic(const std::vector<MosaicPart>& parts, std::optional<double> turn);

} // namespace marsview
