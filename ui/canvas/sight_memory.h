// How maps were looked at, and how new layers are looked at when they replace others.
#pragma once

#include "core/view/camera.h"
#include "ui/canvas/shown_scene.h"

#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// How a map is looked at.
struct Sight {
    OrbitCamera camera;
    double exaggeration = 1.0;
};

/// The last sight of every map that still exists.
class SightMemory {
public:
    void remember(const std::shared_ptr<const Map>& map, const Sight& sight);
    /// `map` takes over the sight of its preview.
    void replacePreview(const std::shared_ptr<const Map>& preview,
                        const std::shared_ptr<const Map>& map);
    std::optional<Sight> find(const std::shared_ptr<const Map>& map) const;

private:
    struct Entry {
        std::weak_ptr<const Map> map;
        Sight sight;
    };

    std::vector<Entry> entries_;
};

/// What the view does when its layers change.
struct NextSight {
    double exaggeration = 1.0;
    std::optional<OrbitCamera> camera; // to jump to; otherwise it stays
    bool is_opening = false;           // shows the opening view of the new map instead
};

/// The camera stays if one of the maps in sight, or the map of a preview in sight, is among the new
/// layers. A map that was shown before gets its last sight, a new one its opening view. `before` is
/// the scene that `now` replaces and `goal` its camera. `exaggeration` is the one that is asked
/// for; otherwise it is the present one if the camera stays, the map's last one, or the one that
/// suits a new map.
NextSight nextSight(const ShownScene& before,
                    const ShownScene& now,
                    const OrbitCamera& goal,
                    const SightMemory& memory,
                    std::optional<double> exaggeration);

/// Whether a map replaces its preview.
bool isCompletionOf(const ShownScene& before, const ShownScene& now);

} // namespace marsview
