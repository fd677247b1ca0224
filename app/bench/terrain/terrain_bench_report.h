// Text reports of measurements of large maps.
#pragma once

#include "app/bench/terrain/terrain_bench.h"

#include <string>

namespace marsview {

/// A measurement's results as lines, each with a line break.
std::string terrainReport(std::string_view measurement, const BenchJson& found);

/// The cost of an update against the size of the map, as SVG; `found` is from measureGrowth().
std::string growthPlot(const BenchJson& found, const std::string& note);

} // namespace marsview
