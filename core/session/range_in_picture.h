// Which maps of a scene the picture shows, and which of their elevations.
#pragma once

#include "core/session/scene_surface.h"
#include "core/view/camera.h"

#include <optional>
#include <vector>

namespace marsview {

struct PictureProbes {
    int columns = 96; // at least 2
    int rows = 64;    // at least 2
};

/// One entry a map of `ground`, top first: the lowest and highest elevation, in metres and not
/// exaggerated, of its surface at probes that are spread evenly over the picture, corners included.
/// Nothing for a map that no probe meets. Maps in tiles answer with the tiles that are loaded. A
/// ray takes some 5 µs.
std::vector<std::optional<HeightRange>> rangesInPicture(const SceneSurface& ground,
                                                        const OrbitCamera& camera,
                                                        const Viewport& viewport,
                                                        double exaggeration,
                                                        const PictureProbes& probes = {});

} // namespace marsview
