// The description of a raster, as `info --json` prints it and the Python module returns it.
#pragma once

#include "core/geo/body.h"
#include "core/raster/raster_info.h"
#include "core/raster/sample_grid.h"

#include <nlohmann/json.hpp>
#include <optional>

namespace marsview {

/// The fields that resources/guide/json.md lists for `info`. Without `statistics` the range of
/// elevations and the number of voids are null. Latitudes are of the given kind.
nlohmann::ordered_json mapReport(const RasterInfo& info,
                                 const std::optional<SampleStatistics>& statistics,
                                 LatitudeKind latitude_kind);

} // namespace marsview
