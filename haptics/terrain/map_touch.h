// What the mouse's stylus touches of a map: all of it where it is held in memory, and the part that
// is there where it comes in tiles.
#pragma once

#include "core/contact/contact_model.h"
#include "core/session/scene_surface.h"
#include "haptics/terrain/resident_terrain.h"
#include "haptics/terrain/window_feeder.h"

#include <cstdint>
#include <memory>

namespace marsview {

/// Contact models over one map. For the GUI thread, which waits for no tile; they are loaded by
/// threads of their own, and only while a model of it is there.
class MapTouch {
public:
    explicit MapTouch(const SceneMap& map);

    /// Whether the map's surface may change by itself while it is touched.
    bool isTiled() const noexcept { return feeder_ != nullptr; }

    /// Null for a map that is held in memory without what fills its voids.
    std::unique_ptr<MapContactModel>
    makeModel(ContactModelKind kind, double exaggeration, const ContactModelOptions& options);

    /// Tells where the hand is, and takes in what has been loaded since. True where the surface
    /// has changed: `model` has been told, and wants an update.
    bool follow(MapContactModel& model, const ScenePoint& hand);
    /// The hand is gone: nothing is loaded for it any more.
    void release();

private:
    SceneMap map_;
    std::unique_ptr<WindowFeeder> feeder_; // of a map in tiles
    std::shared_ptr<ResidentTerrain> terrain_;
    bool is_followed_ = false;
};

} // namespace marsview
