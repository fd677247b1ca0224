// How far a drawn surface is from the true one, in the pixels of the picture.
#pragma once

#include "core/geo/scene_frame.h"
#include "core/terrain/heightfield.h"
#include "core/view/camera.h"

#include <cstddef>
#include <span>

namespace marsview {

/// Of all pixels that show ground.
struct PictureError {
    std::size_t pixel_count = 0;
    double share_within = 1.0; // of pixels that are off by at most the threshold
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

/// Compares what was drawn with the surface at full resolution: each pixel's point is moved up or
/// down to the true surface, and the way it moves in the picture is its error. `depths_m` are
/// distances along the view axis, width × height from the top left, infinite in the sky. Points
/// over voids or beside the map are left out.
PictureError measurePictureError(const DrawnScene& scene,
                                 const OrbitCamera& camera,
                                 const Viewport& viewport,
                                 std::span<const double> depths_m,
                                 double threshold_px);

} // namespace marsview
