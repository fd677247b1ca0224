// Figures about a part of a profile.
#pragma once

#include "core/measure/line_measures.h"

namespace marsview {

/// Elevations along a part of a profile. NaN where the part has none.
struct ProfileStatistics {
    double length_m = 0.0;  // of the part, gaps included
    double surface_m = 0.0; // along the terrain, without gaps
    double min_m = 0.0;
    double max_m = 0.0;
    double mean_m = 0.0;         // weighted by distance
    double climb_m = 0.0;        // the sum of all rises
    double descent_m = 0.0;      // the sum of all falls, positive
    double mean_slope_deg = 0.0; // of the line from the first elevation to the last
    double steepest_deg = 0.0;   // of the steps between points, whichever way
    double gap_m = 0.0;          // the length without elevations
};

/// Of the part from `begin_m` to `end_m` along `profile`; elevations at the ends are interpolated.
ProfileStatistics profileStatistics(const Profile& profile, double begin_m, double end_m);

} // namespace marsview
