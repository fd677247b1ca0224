// A map as the servo thread uses it.
#pragma once

#include "core/contact/contact_model.h"
#include "core/contact/goal_frame.h"
#include "core/terrain/filled_heightfield.h"
#include "haptics/terrain/servo_terrain.h"

#include <cstdint>
#include <memory>

namespace marsview {

/// Heights of the surface that a contact model touches. Servo thread.
class SurfaceHeights {
public:
    virtual ~SurfaceHeights() = default;
    /// In scene meters, with the exaggeration, at a grid position, which is clamped to the grid.
    virtual double height(const GridPoint& at) const noexcept = 0;
};

/// Created and destroyed by any thread except the servo thread; used only by the servo thread.
struct ServoMap {
    GoalFrame frame;
    std::unique_ptr<MapContactModel> model;
    std::unique_ptr<const SurfaceHeights> heights; // of the same surface
    std::shared_ptr<ServoTerrain> terrain;         // null if the map is in memory
    ContactModelKind kind = kContactModelDefault;  // of the model
    double radius_m = 1.0;                         // of the model's sphere, if it has one
    std::uint64_t map_id = 0;                      // identifies the touched map
    std::uint64_t serial = 0;                      // unique for each ServoMap
    bool is_touched = false;                       // the model already has a proxy

    double height(const GridPoint& at) const noexcept { return heights->height(at); }
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
/// A tiled map. Several ServoMaps that the servo thread uses one after the other may share the
/// terrain.
std::shared_ptr<ServoMap> makeServoMap(const GoalFrame& frame,
                                       std::shared_ptr<ServoTerrain> terrain,
                                       const ServoMapOptions& options);

} // namespace marsview
