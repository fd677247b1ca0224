// The part of the map that the camera sees, in plan view.
#pragma once

#include "core/geo/scene_frame.h"
#include "core/view/camera.h"

#include <cstddef>
#include <vector>

namespace marsview {

/// A map as a rectangle of samples in the scene.
struct MapPlan {
    SceneFrame frame;
    std::size_t columns = 2; // >= 2
    std::size_t rows = 2;    // >= 2
};

/// The part of the map in the picture, assuming level terrain at the height of the camera's target:
/// a convex polygon within the outermost samples, with its corners in order, limited by the horizon
/// and the map. Empty if no part of the map is in the picture or its area is 0 in doubles.
std::vector<GridPoint>
footprint(const OrbitCamera& camera, const Viewport& viewport, const MapPlan& map);

/// The fraction of the map's area that a polygon covers, 0 … 1.
double shareOfMap(const std::vector<GridPoint>& polygon, const MapPlan& map);

/// The camera in plan view: its position and the directions of the left and right edge of the
/// picture at half height. The lines from the eye along `left` and `right` meet the footprint's
/// sides at the level of the target. For a view straight down they point to opposite sides.
struct CameraWedge {
    GridPoint eye; // may be outside the map
    Vec3 left;     // level scene directions of length 1
    Vec3 right;
    double length_m = 0.0; // along either, from the eye to the side
};

CameraWedge
cameraWedge(const OrbitCamera& camera, const Viewport& viewport, const SceneFrame& frame);

} // namespace marsview
