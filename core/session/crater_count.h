// Counts of craters in an area, for the dating of surfaces by their crater frequency.
#pragma once

#include "core/base/result.h"
#include "core/geo/body.h"
#include "core/geo/frames.h"
#include "core/session/measurement_features.h"

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace marsview {

struct CountedCrater {
    MapPoint center; // longitude and latitude as tablePosition() has them
    double diameter_m = 0.0;
};

/// Craters whose centers lie in the areas; each counts in full.
struct CraterCount {
    Ellipsoid ellipsoid;
    std::string crs_name;
    struct Area {
        std::string name;
        std::vector<MapPoint> border; // longitudes and latitudes, without the first one again
        double area_m2 = 0.0;         // on the ellipsoid
        double perimeter_m = 0.0;
    };
    std::vector<Area> areas{};
    std::vector<CountedCrater> craters{};
    std::size_t outside = 0; // craters that are left out, because they lie in none of the areas
    std::chrono::system_clock::time_point time{}; // of the last crater
};

/// The craters and areas among the measurements. Invalid, with the remedy, without a crater or an
/// area, if they are on several bodies, or on a map without one.
Result<CraterCount> craterCount(std::span<const NamedMeasurement> measurements);

/// The spatial crater count file (.scc) of CraterTools and Craterstats: borders, and diameters with
/// positions. Lengths in kilometers.
std::string sccText(const CraterCount& count);

/// The diameter file (.diam) of Craterstats: the area, and diameters with positions.
std::string diamText(const CraterCount& count);

/// Whether a position lies within a border whose edges are geodesics and that covers less than half
/// of the body.
bool isInside(const Ground& ground,
              std::span<const GroundPosition> border,
              GroundPosition position);

} // namespace marsview
