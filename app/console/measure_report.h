// Measurements as `measure --json` prints them and the Python module returns them.
#pragma once

#include "core/measure/attitude.h"
#include "core/measure/crater.h"
#include "core/measure/line_measures.h"
#include "core/measure/terrain_area.h"

#include <nlohmann/json.hpp>

namespace marsview {

/// `surface_m`, or NaN if a part of the line is void: its length along the terrain is then unknown.
double wholeSurface(double surface_m, double void_m);

// The fields that resources/guide/json.md lists. Positions in degrees of the kind of latitude that
// people read.

nlohmann::ordered_json reportOf(const Distance& distance);
nlohmann::ordered_json reportOf(const Attitude& attitude, GroundPosition center);
/// Without the hypsometry.
nlohmann::ordered_json reportOf(const TerrainArea& area);
/// An array of classes.
nlohmann::ordered_json reportOf(const Hypsometry& hypsometry);
/// `map` is the center in the CRS of the map; NaN outside its projection.
nlohmann::ordered_json reportOf(const Crater& crater, GroundPosition center, MapPoint map);

} // namespace marsview
