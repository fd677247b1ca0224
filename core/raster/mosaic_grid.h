// Where adjoining rasters lie on the one grid that they share.
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
    double covered = 1.0;           // share of the samples that some part has, (0, 1]
};

/// Lays out the parts, of which there is at least one. Neighbours may share columns and rows, or
/// leave gaps. Where `turn` is the map's length around the body and a whole number of samples,
/// parts on both sides of the antimeridian come to lie side by side. Invalid where the parts are
/// rotated, or their samples do not lie on one grid to a twentieth of a pixel: the message names
/// the first part that does not fit, and what it does not fit to.
Result<MosaicGrid> layOutMosaic(const std::vector<MosaicPart>& parts, std::optional<double> turn);

} // namespace marsview
