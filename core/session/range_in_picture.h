// The maps of a scene that the picture shows, and the elevation range of each.
#pragma once

#include "core/session/body_terrain.h"
#include "core/session/scene_surface.h"
#include "core/view/camera.h"

#include <optional>
#include <vector>

namespace marsview {

struct PictureProbes {
    int columns = 96; // at least 2
    int rows = 64;    // at least 2
};

/// One entry per map of `ground`, top first: the lowest and highest elevation, in meters without
/// exaggeration, at probes spread evenly over the picture, corners included. Empty for a map that
/// no probe hits. Tiled maps use the tiles that are loaded. A ray takes some 5 µs.
std::vector<std::optional<HeightRange>> rangesInPicture(const SceneSurface& ground,
                                                        const OrbitCamera& camera,
                                                        const Viewport& viewport,
                                                        double exaggeration,
                                                        const PictureProbes& probes = {});

/// The same for the maps of a body, by rays that take some 20 µs.
std::vector<std::optional<HeightRange>> rangesInPicture(const BodyScene& scene,
                                                        const CameraPose& camera,
                                                        const Viewport& viewport,
                                                        double exaggeration,
                                                        const PictureProbes& probes = {});

} // namespace marsview
