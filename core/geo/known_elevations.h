// How high and how low the places of a body are, as far as it is well known.
#pragma once

#include "core/geo/body.h"

#include <optional>

namespace marsview {

/// In meters. `lowest_m` and `highest_m` are above the usual reference of the body's maps (areoid,
/// sphere, sea level). Elevations outside [floor_m, ceiling_m] are those of no place, whichever
/// sphere, ellipsoid or areoid in use they refer to.
struct KnownElevations {
    double lowest_m = 0.0;
    double highest_m = 0.0;
    double floor_m = 0.0;
    double ceiling_m = 0.0;
};

/// Empty for bodies whose extremes are not well known.
std::optional<KnownElevations> knownElevations(const Body& body);

/// Whether some place on the body may have this elevation; true if its extremes are not well known.
/// `sphere_m` is given for heights above one sphere, from a raster of radii: near the poles of an
/// oblate body they are lower than those above its ellipsoid.
bool canBeOn(const Body& body, double elevation_m, std::optional<double> sphere_m = std::nullopt);

} // namespace marsview
