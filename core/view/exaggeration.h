// How much heights are stretched in the view.
#pragma once

#include "core/view/camera.h"

namespace marsview {

/// The factor at which relief is easily seen on a map of that size: a round number, about
/// extent / (60 × relief), at least 1 for relief that shows by itself. Below 1 only where heights
/// exceed a third of the extent, as in a map without georeferencing. 1 where nothing is known.
double defaultExaggeration(double extent_m, double relief_m);

/// The next round number (1, 1.5, 2, 3, 5, 7, 10 of a decade) above, or below for steps < 0.
/// Bounded to [1e-6, 1e6].
double steppedExaggeration(double exaggeration, int steps);

/// The factors that people choose from: 0.1 to 100, and a decade beyond `suitable` where that lies
/// outside, as for maps without georeferencing.
struct ExaggerationRange {
    double least = 0.1;
    double most = 100.0;
};
ExaggerationRange exaggerationRange(double suitable);

/// The camera that looks at the same piece of ground after the exaggeration changed: the target
/// moves with the ground, the eye with the target.
OrbitCamera reexaggerated(OrbitCamera camera, double from, double to);

} // namespace marsview
