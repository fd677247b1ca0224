// The triangles of maps on their body: of one map, and of several as one surface to touch.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/body/body_mesh.h"
#include "core/body/layered_mesh.h"
#include "core/body/tiled_body_mesh.h"
#include "core/levels/tile_heights.h"
#include "core/levels/waiting_terrain.h"
#include "core/session/body_terrain.h"

#include <memory>
#include <vector>

namespace marsview {

/// A map as it is shown (BodyTerrain::shown()).
struct BodyLayer {
    std::shared_ptr<const BodyMesh> mesh; // of a map in memory
    /// Of a map in tiles, and that map.
    std::shared_ptr<const TiledBodyMesh> tiled{};
    std::shared_ptr<const Map> map{};
};

/// Bounds of all triangles take a second for fifty million samples. Errors: those of BodyMesh and
/// TiledBodyMesh. Any thread but the GUI's.
Result<BodyLayer> layOnBody(const BodyTerrain& terrain, double exaggeration, JobMonitor& monitor);

struct JoinedLayers {
    /// Maps in tiles wait for theirs: each user puts them over terrains of its own.
    std::shared_ptr<const LayeredMesh> mesh;
    std::vector<std::shared_ptr<const WaitingTerrain>> waiting; // of these, the uppermost first
};

/// The uppermost first. Errors: those of LayeredMesh, and of tiles. Any thread but the GUI's.
Result<JoinedLayers> joinLayers(const std::vector<BodyLayer>& layers, JobMonitor& monitor);

/// What the triangles of a map in tiles need of its analysis.
std::shared_ptr<const TileHeights> tileHeightsOf(const Map& map);

} // namespace marsview
