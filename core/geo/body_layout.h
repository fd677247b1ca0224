// Which samples of a raster make up its surface on the body, and where that surface closes.
#pragma once

#include "core/base/result.h"
#include "core/geo/georeference.h"

#include <cstddef>

namespace marsview {

/// Of a raster whose columns are meridians. A column that repeats the first one after a full turn,
/// and rows that lie at a pole, where all their samples meet, are left out.
struct BodyLayout {
    std::size_t columns = 0; // that are used
    std::size_t rows = 0;
    std::size_t first_row = 0;  // of the raster
    bool has_row_after = false; // at a pole
    bool wraps = false;         // the last column is next to the first
    // Whether the first and the last row go around a pole at a distance of at most one cell, so
    // that triangles to the pole close the surface there.
    bool closes_first = false;
    bool closes_last = false;
};

/// Whether longitude depends on the column alone and latitude on the row alone.
bool hasMeridiansAsColumns(const Georeference& georeference);

/// Of a raster with hasMeridiansAsColumns() and at least 2 × 2 samples. Invalid if it extends over
/// more than a full turn of longitude. Rows outside the projection are used, too. Calls PROJ for
/// nine positions.
Result<BodyLayout> bodyLayout(const Georeference& georeference);

} // namespace marsview
