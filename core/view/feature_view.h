// How far away the camera shows all of a feature on a body.
#pragma once

#include "core/geo/georeference.h"
#include "core/view/camera.h"

#include <optional>

namespace marsview {

/// A place on a map and the length across it in the scene, in meters, in the direction in which the
/// projection stretches it most.
struct FeatureExtent {
    GridPoint center;
    double across_m = 0.0;
};

/// The extent of a circle of `diameter_m` (>= 0) around a place. Empty if the place is not on the
/// map's outermost samples or within them. Calls PROJ some ten times.
std::optional<FeatureExtent>
featureExtent(const Georeference& map, const GeographicPoint& center, double diameter_m);

/// The distance at which `across_m` takes `share` (0 … 1) of the picture's shorter side at the
/// camera's target.
double
distanceShowing(double across_m, double share, Angle field_of_view, const Viewport& viewport);

} // namespace marsview
