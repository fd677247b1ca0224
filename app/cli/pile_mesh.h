// Maps on top of each other as one surface to touch.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/session/body_terrain.h"
#include "haptics/terrain/body_layers.h"

#include <memory>
#include <vector>

namespace marsview {

struct PileMesh {
    JoinedLayers joined;
    /// These two: of the maps in tiles, the uppermost first.
    std::vector<std::shared_ptr<const Map>> in_tiles;
    std::vector<std::shared_ptr<const TiledBodyMesh>> tiled;
    std::vector<std::shared_ptr<const Georeference>> georeferences; // of all, the uppermost first
    double radius_m = 0.0;                                          // half a cell of the finest map
};

/// The uppermost first. Errors: those of layOnBody() and joinLayers().
Result<PileMesh>
joinedPile(const std::vector<BodyTerrain>& maps, double exaggeration, JobMonitor& monitor);

} // namespace marsview
