// A map as the servo thread touches it.
#pragma once

#include "core/contact/contact_model.h"
#include "core/contact/goal_frame.h"
#include "core/terrain/filled_heightfield.h"
#include "haptics/terrain/servo_terrain.h"

#include <cstdint>
#include <memory>

namespace marsview {

/// Made and destroyed by any thread but the servo's; used by the servo's alone.
struct ServoMap {
    GoalFrame frame;
    std::unique_ptr<MapContactModel> model;
    std::shared_ptr<ServoTerrain> terrain;        // null where the map is held in memory
    ContactModelKind kind = kContactModelDefault; // of the model
    double radius_m = 1.0;                        // the same of its sphere, where it has one
    std::uint64_t map_id = 0;                     // of what is touched: another one is another map
    std::uint64_t serial = 0;                     // of this object; no two are alike
    bool is_touched = false;                      // the model has a proxy already
};

struct ServoMapOptions {
    ContactModelKind kind = kContactModelDefault;
    ContactModelOptions contact{};
    std::uint64_t map_id = 1;
};

/// A map in memory.
std::shared_ptr<ServoMap> makeServoMap(const GoalFrame& frame,
                                       std::shared_ptr<const FilledHeightfield> filled,
                                       const ServoMapOptions& options);
/// A map in tiles. Several ServoMaps, of which the servo uses one after the other, may share the
/// terrain.
std::shared_ptr<ServoMap> makeServoMap(const GoalFrame& frame,
                                       std::shared_ptr<ServoTerrain> terrain,
                                       const ServoMapOptions& options);

} // namespace marsview
