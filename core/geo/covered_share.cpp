#include "core/geo/covered_share.h"

#include "core/geo/georeference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace marsview {
namespace {

constexpr int kPlaces = 4096;

// The i-th of places evenly spread over a sphere: a Fibonacci lattice. The flattening of planets
// does not matter here.
GeographicPoint placeAt(int i)
{
    const double sine = 1.0 - (2.0 * i + 1.0) / kPlaces;
    const double turns = i / std::numbers::phi;
    return {.longitude = Angle::degrees(360.0 * (turns - std::floor(turns)) - 180.0),
            .latitude = Angle::radians(std::asin(sine))};
}

bool covers(const Georeference& raster, const GeographicPoint& place)
{
    const auto grid = raster.toGrid(place);
    return grid && grid->column >= -0.5 && grid->row >= -0.5 &&
           grid->column <= static_cast<double>(raster.columns()) - 0.5 &&
           grid->row <= static_cast<double>(raster.rows()) - 0.5;
}

} // namespace

double coveredShare(std::span<const Georeference* const> rasters)
{
    int covered = 0;
    for (int i = 0; i < kPlaces; ++i) {
        const GeographicPoint place = placeAt(i);
        if (std::ranges::any_of(rasters,
                                [&](const auto* raster) { return covers(*raster, place); })) {
            ++covered;
        }
    }
    return static_cast<double>(covered) / kPlaces;
}

} // namespace marsview
