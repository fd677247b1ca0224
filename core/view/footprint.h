// What part of the map the camera sees, seen from above.
#pragma once

#include "core/geo/scene_frame.h"
#include "core/view/camera.h"

#include <cstddef>
#include <vector>

namespace marsview {

/// A map as a rectangle of samples, laid out in the scene.
struct MapPlan {
    SceneFrame frame;
    std::size_t columns = 2; // >= 2
    std::size_t rows = 2;    // >= 2
};

/// The part of the map that is in the picture if the ground is level at the height of the camera's
/// target: a convex polygon within the outermost samples, its corners in order. It ends at the
/// horizon, and otherwise where the map does. Empty where none of the map is in the picture or what
/// there is has no area in doubles.
std::vector<GridPoint>
footprint(const OrbitCamera& camera, const Viewport& viewport, const MapPlan& map);

/// The share of the map's area that a polygon covers, 0 … 1.
double shareOfMap(const std::vector<GridPoint>& polygon, const MapPlan& map);

/// The camera from above: where it stands and what it has between the left and the right edge of
/// the picture, halfway up. The lines from the eye along `left` and `right` meet the footprint's
/// sides level with the target; straight down they point to opposite sides.
struct CameraWedge {
    GridPoint eye; // may be beside the map
    Vec3 left;     // level scene directions of length 1
    Vec3 right;
    double length_m = 0.0; // along either, from the eye to where it meets the side
};

CameraWedge
cameraWedge(const OrbitCamera& camera, const Viewport& viewport, const SceneFrame& frame);

} // namespace marsview
