// A map for a servo loop: in memory, or tiled with the thread that loads its tiles.
#pragma once

#include "app/console/map_options.h"
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
};

/// Loads tiles during its lifetime. Until the loop has ended only the servo thread may use the map.
struct LoopMap {
    std::shared_ptr<const Map> opened;
    std::unique_ptr<TouchMap> touch;
    std::shared_ptr<ServoMap> map;
    SceneBox box;        // of the whole map
    double cell_m = 1.0; // scene meters, the mean of both sides
};

Result<LoopMap>
openLoopMap(const MapOptions& map, const LoopMapOptions& options, JobMonitor& monitor);

} // namespace marsview
