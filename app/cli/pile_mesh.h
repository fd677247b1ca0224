// Maps on top of each other as one surface to touch.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/body/layered_mesh.h"
#include "core/body/tiled_body_mesh.h"
#include "core/levels/waiting_terrain.h"
#include "core/session/body_terrain.h"

#include <memory>
#include <vector>

namespace marsview {

/// In `mesh`, maps in tiles wait for theirs.
struct PileMesh {
    std::shared_ptr<const LayeredMesh> mesh;
    /// These three: of the maps in tiles, the uppermost first.
    std::vector<std::shared_ptr<const Map>> in_tiles;
    std::vector<std::shared_ptr<const TiledBodyMesh>> tiled;
    std::vector<std::shared_ptr<const WaitingTerrain>> waiting;
    std::vector<std::shared_ptr<const Georeference>> georeferences; // of all, the uppermost first
    double radius_m = 0.0;                                          // half a cell of the finest map
};

/// The uppermost first. Errors: those of BodyMesh, of LayeredMesh, and of tiles.
Result<PileMesh>
joinedPile(const std::vector<BodyTerrain>& maps, double exaggeration, JobMonitor& monitor);

} // namespace marsview
