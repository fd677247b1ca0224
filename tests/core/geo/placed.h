// Rasters from the terms of their transformation.
#pragma once

#include "core/geo/georeference.h"

#include <cstddef>
#include <numbers>
#include <string>

namespace marsview {

inline constexpr double kDegree = std::numbers::pi / 180.0;

// Columns and rows of samples; the terms place them in the CRS named.
inline Georeference placed(std::size_t columns,
                           std::size_t rows,
                           const GeoTransform::Terms& terms,
                           const std::string& crs)
{
    return {columns, rows, *GeoTransform::fromTerms(terms), *Crs::fromText(crs)};
}

} // namespace marsview
