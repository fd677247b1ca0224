// The difference between a drawn surface and the true one, in pixels of the picture.
#pragma once

#include "core/geo/scene_frame.h"
#include "core/terrain/heightfield.h"
#include "core/view/camera.h"

#include <cstddef>
#include <span>

namespace marsview {

/// Over all pixels that show terrain.
struct PictureError {
    std::size_t pixel_count = 0;
    double share_within = 1.0; // of pixels with an error of at most the threshold
    double mean_px = 0.0;
    double p99_px = 0.0;
    double max_px = 0.0;
};

/// A map as it was drawn.
struct DrawnScene {
    const Heightfield& heightfield;
    const SceneFrame& frame;
    double exaggeration = 1.0;
};

/// Compares a picture with the surface at full resolution: each pixel's point is moved vertically
/// to the true surface, and its displacement in the picture is the error. `depths_m` are distances
/// along the view axis, width × height from the top left, infinite in the sky. Points over voids or
/// outside the map are skipped.
PictureError measurePictureError(const DrawnScene& scene,
                                 const OrbitCamera& camera,
                                 const Viewport& viewport,
                                 std::span<const double> depths_m,
                                 double threshold_px);

} // namespace marsview
