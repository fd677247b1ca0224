// Vertical exaggeration of the view.
#pragma once

#include "core/view/camera.h"

namespace marsview {

/// Below, heights vanish beside rounding, and above, lengths.
constexpr double kExaggerationMin = 1e-6;
constexpr double kExaggerationMax = 1e6;

/// The factor that makes relief clearly visible on a map of that size: a round number, about extent
/// / (60 × relief), at least 1 for relief that is visible by itself. Below 1 only if heights exceed
/// a third of the extent, as in a map without georeferencing. 1 if nothing is known.
double defaultExaggeration(double extent_m, double relief_m);

/// The next round number (1, 1.5, 2, 3, 5, 7, 10 of a decade) above, or below for steps < 0.
/// Bounded to [kExaggerationMin, kExaggerationMax].
double steppedExaggeration(double exaggeration, int steps);

/// The range of selectable factors: 0.1 to 100, extended by a decade beyond `suitable` if that lies
/// outside, as for maps without georeferencing.
struct ExaggerationRange {
    double least = 0.1;
    double most = 100.0;
};
ExaggerationRange exaggerationRange(double suitable);

/// The camera that looks at the same terrain after a change of exaggeration: the target moves with
/// the terrain, the eye with the target.
OrbitCamera reexaggerated(OrbitCamera camera, double from, double to);

} // namespace marsview
