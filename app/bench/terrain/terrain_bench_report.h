// What was measured of large maps, for people.
#pragma once

#include "app/bench/terrain/terrain_bench.h"

#include <string>

namespace marsview {

/// Lines, each ended, about what the measurement of that name found.
std::string terrainReport(std::string_view measurement, const BenchJson& found);

/// What an update costs against the size of the map, as SVG; `found` is measureGrowth's.
std::string growthPlot(const BenchJson& found, const std::string& note);

} // namespace marsview
