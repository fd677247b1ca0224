// Shared by commands that draw: a map, a renderer without a window, a camera.
#pragma once

#include "app/console/map_options.h"
#include "app/console/map_pile.h"
#include "app/console/scene_option.h"
#include "core/session/map.h"
#include "core/view/navigation.h"
#include "ui/render/opengl/egl_context.h"
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
    double exaggeration = 1.0;                   // that suits the map
    std::shared_ptr<const BodyGrid> body_grid{}; // of the map, on its body; null in the flat scene
    BodyScene on_body{};                         // of the map and those below it, if it is there

    /// The default ramp of the map's body.
    const ColorRamp& ramp() const;
    /// The box of the map at an exaggeration.
    SceneBox box(double with_exaggeration) const;
    /// The terrain to use where tiles of the map are missing: Now uses the coarser tiles that
    /// replace them, Waiting loads the tiles themselves.
    enum class Ground { Now, Waiting };

    /// Height of the terrain in scene meters; NaN outside the map and in voids.
    double ground(double east_m,
                  double north_m,
                  double with_exaggeration,
                  Ground which = Ground::Now) const;
    /// The camera moved within the limits of navigation and above the terrain.
    OrbitCamera
    bounded(const OrbitCamera& camera, double with_exaggeration, Ground which = Ground::Now) const;
};

/// A renderer without a map; `notify` is TerrainRenderer's. Call it first, since it fails early.
Result<Scene> emptyScene(std::function<void()> notify = {});
/// From now on the map is drawn. `ramp` is null for the one that suits the body.
void showIn(Scene& scene, std::shared_ptr<const Map> map, const ColorRamp* ramp);
/// The same, in the scene of the map's body, over the maps below it. All are colored by one range
/// of elevations. Errors: those of pileOnBody().
Status showOnBody(Scene& scene,
                  std::shared_ptr<const Map> map,
                  const ColorRamp* ramp,
                  const PileOptions& pile = {});

/// Reads and analyzes the map, showing progress. `ramp` is null for the body's default; `notify` is
/// TerrainRenderer's.
Result<Scene> openScene(const MapOptions& options,
                        const ColorRamp* ramp,
                        std::function<void()> notify = {},
                        SceneKind kind = SceneKind::Flat,
                        const PileOptions& pile = {});

/// The size that the option --size says: "1280x800".
Result<Viewport> viewportFrom(const std::string& text);
/// Refuses what viewportFrom() refuses.
CLI::Validator pictureSize();

} // namespace marsview
