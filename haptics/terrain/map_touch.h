// The part of a map that the mouse stylus can touch: all of a map in memory, or the resident tiles
// of a tiled map.
#pragma once

#include "core/contact/contact_model.h"
#include "core/session/scene_surface.h"
#include "haptics/terrain/clipmap_streamer.h"
#include "haptics/terrain/resident_terrain.h"

#include <cstdint>
#include <memory>

namespace marsview {

/// Contact models over one map. For the GUI thread: it does not wait for tiles, which are loaded by
/// separate threads while a model of the map exists.
class MapTouch {
public:
    explicit MapTouch(const SceneMap& map);

    /// Whether the map's surface may change by itself while it is touched.
    bool isTiled() const noexcept { return feeder_ != nullptr; }

    /// Null for a map in memory whose voids have not been filled.
    std::unique_ptr<MapContactModel>
    makeModel(ContactModelKind kind, double exaggeration, const ContactModelOptions& options);

    /// Reports the hand's position and applies newly loaded tiles. Returns true if the surface has
    /// changed: `model` has been notified and needs an update.
    bool follow(MapContactModel& model, const ScenePoint& hand);
    /// The hand is gone: loading stops.
    void release();

private:
    SceneMap map_;
    std::unique_ptr<ClipmapStreamer> feeder_; // for a tiled map
    std::shared_ptr<ResidentTerrain> terrain_;
    bool is_followed_ = false;
};

} // namespace marsview
