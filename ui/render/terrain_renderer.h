// Drawing a map with OpenGL 3.3 core. No Qt: whoever has a current context may draw.
#pragma once

#include "core/base/angle.h"
#include "core/base/result.h"
#include "core/view/camera.h"
#include "core/view/color_ramp.h"
#include "ui/render/terrain_draw_data.h"

#include <memory>
#include <string>

namespace marsview {

/// How the terrain looks. Changing any of it costs nothing but the next frame.
struct DrawStyle {
    double exaggeration = 1.0;
    const ColorRamp* ramp = nullptr;             // never null when drawing; static data
    Angle light_azimuth = Angle::degrees(315.0); // where the light comes from
    Angle light_altitude = Angle::degrees(45.0);
    Rgb8 sky_top{12, 15, 22};
    Rgb8 sky_bottom{34, 40, 50};
};

/// Draws one map. Every call needs the context current in which the renderer was created, the
/// destructor included. Leaves no program, buffer or vertex array bound.
class TerrainRenderer {
public:
    /// Unsupported where the context is older than OpenGL 3.3 or refuses the shaders.
    static Result<std::unique_ptr<TerrainRenderer>> create();

    ~TerrainRenderer();
    TerrainRenderer(const TerrainRenderer&) = delete;
    TerrainRenderer& operator=(const TerrainRenderer&) = delete;

    RenderLimits limits() const;
    /// The driver's name for itself: "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& driver() const;

    /// The map to draw from now on; null for none. The previous one stays in the picture until
    /// advance() has sent this one to the driver whole.
    void setTerrain(std::shared_ptr<const TerrainDrawData> data);

    /// Sends a part of what is still to be sent, a few milliseconds of work, and returns
    /// isComplete().
    bool advance();
    /// True when draw() shows everything of the current terrain.
    bool isComplete() const;

    /// Draws what has arrived into the bound frame buffer, from its lower left corner.
    void draw(const OrbitCamera& camera, const DrawStyle& style, const Viewport& viewport);

private:
    struct Impl;
    explicit TerrainRenderer(std::unique_ptr<Impl> impl);

    std::unique_ptr<Impl> impl_;
};

} // namespace marsview
