// A map for a servo loop: in memory, tiled with the thread that loads its tiles, or on its body.
#pragma once

#include "app/console/map_options.h"
#include "app/console/map_pile.h"
#include "app/console/scene_option.h"
#include "core/body/body_grid.h"
#include "core/body/body_mesh.h"
#include "core/contact/contact_model.h"
#include "core/session/map.h"
#include "core/view/scene_box.h"
#include "haptics/terrain/touch_map.h"

#include <memory>
#include <optional>

namespace marsview {

struct LoopMapOptions {
    ContactModelKind kind = kContactModelDefault;
    double exaggeration = 1.0;
    std::optional<double> radius_m; // of virtual-proxy; default half a cell
    SceneKind scene = SceneKind::Flat;
    PileOptions pile; // of the body scene
};

/// Loads tiles during its lifetime. Until the loop has ended only the servo thread may use the map.
struct LoopMap {
    std::shared_ptr<const Map> opened;
    std::unique_ptr<TouchMap> touch;      // null for a map in memory on the body
    std::shared_ptr<const BodyMesh> mesh; // these three: on the body
    std::shared_ptr<const BodyGrid> grid;
    BodyScene on_body; // the map and those below it
    std::shared_ptr<ServoMap> map;
    SceneBox box;        // of the whole map, in the plane
    double cell_m = 1.0; // scene meters, the mean of both sides
};

Result<LoopMap>
openLoopMap(const MapOptions& map, const LoopMapOptions& options, JobMonitor& monitor);

} // namespace marsview
