// A map of the scene for the servo thread.
#pragma once

#include "core/session/scene_surface.h"
#include "haptics/terrain/clipmap_streamer.h"
#include "haptics/terrain/servo_map.h"

#include <cstdint>
#include <memory>

namespace marsview {

/// Makes what the servo thread touches of one map, again and again with other models and
/// exaggerations. Lives in the GUI thread, which waits for no tile; for a map in tiles a thread
/// brings them while this is there.
class HandMap {
public:
    explicit HandMap(const SceneMap& map);

    bool isOf(const SceneMap& map) const { return map.map == map_.map && map.frame == map_.frame; }
    const SceneMap& map() const noexcept { return map_; }

    /// Null for a map that is held in memory without what fills its voids.
    std::shared_ptr<ServoMap> make(ContactModelKind kind, double exaggeration) const;

private:
    SceneMap map_;
    std::uint64_t map_id_ = 0;
    std::unique_ptr<ClipmapStreamer> feeder_; // of a map in tiles
    std::shared_ptr<ServoTerrain> terrain_;
};

} // namespace marsview
