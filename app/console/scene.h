// What commands that draw have in common: a map, a renderer without a window, a camera.
#pragma once

#include "app/console/map_options.h"
#include "core/session/map.h"
#include "core/view/navigation.h"
#include "ui/render/egl_context.h"
#include "ui/render/terrain_renderer.h"

#include <functional>
#include <memory>
#include <string>

namespace CLI {
class Validator;
}

namespace marsview {

/// A map ready to be drawn on this thread.
struct Scene {
    std::unique_ptr<EglContext> context; // outlives the renderer
    std::unique_ptr<TerrainRenderer> renderer;
    std::shared_ptr<const Map> map;
    double exaggeration = 1.0; // that suits the map

    /// The ramp that suits the map's body.
    const ColorRamp& ramp() const;
    /// The box of the map at an exaggeration.
    SceneBox box(double with_exaggeration) const;
    /// Which ground counts where tiles of the map are missing: what stands in for them now, or
    /// their own, which is waited for.
    enum class Ground { Now, Waiting };

    /// Height of the ground in scene metres; NaN beside the map and in voids.
    double ground(double east_m,
                  double north_m,
                  double with_exaggeration,
                  Ground which = Ground::Now) const;
    /// The camera within the bounds of navigation, above the ground.
    OrbitCamera
    bounded(const OrbitCamera& camera, double with_exaggeration, Ground which = Ground::Now) const;
};

/// A renderer without a map; `notify` is TerrainRenderer's. This first, as it fails at once.
Result<Scene> emptyScene(std::function<void()> notify = {});
/// From now on the map is drawn. `ramp` is null for the one that suits the body.
void showIn(Scene& scene, std::shared_ptr<const Map> map, const ColorRamp* ramp);

/// Reads and analyses the map, showing progress. `ramp` is null for the one that suits the body;
/// `notify` is TerrainRenderer's.
Result<Scene>
openScene(const MapOptions& options, const ColorRamp* ramp, std::function<void()> notify = {});

/// The size that the option --size says: "1280x800".
Result<Viewport> viewportFrom(const std::string& text);
/// Refuses what viewportFrom() refuses.
CLI::Validator pictureSize();

} // namespace marsview
