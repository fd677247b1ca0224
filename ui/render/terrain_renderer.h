// Drawing maps with OpenGL 3.3 core. No Qt: whoever has a current context may draw.
#pragma once

#include "core/base/result.h"
#include "core/files/picture_file.h"
#include "core/view/camera.h"
#include "core/view/color_ramp.h"
#include "core/view/detail_selection.h"
#include "core/view/terrain_look.h"
#include "ui/render/frame_target.h"
#include "ui/render/terrain_layer.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// How the terrain looks. Changing any of it costs nothing but the next frame.
struct DrawStyle {
    double exaggeration = 1.0;
    TerrainLook look;
    Rgb8 sky_top{12, 15, 22};
    Rgb8 sky_bottom{34, 40, 50};
};

/// Samples per pixel for smooth edges.
inline constexpr int kSmoothSamples = 4;

/// One picture: from where, how large, how fine.
struct DrawRequest {
    OrbitCamera camera{};
    Viewport viewport;
    DetailTarget detail{};
    double scale = 1.0;   // share of the viewport's width and height that is drawn, then enlarged
    int samples = 1;      // a pixel
    bool is_kept = false; // for present()
    /// For pictures in motion: takes up only some of the shading that has come, and, in software,
    /// from the nearest level of its texture instead of two.
    bool is_hasty = false;
    /// Draws this part of the viewport alone, into a target of its size: at scale 1, not kept, with
    /// the samples that the target has.
    std::optional<PixelArea> part{};
    /// A better picture follows at once: in software, colors are those of the mesh's place.
    bool is_interim = false;
    /// Drawn pixels along the side of one that is shown; contour lines are that wide.
    int pixels_shown_as_one = 1;
    std::optional<CameraPose> body_pose{}; // replaces `camera` where layers lie on their body

    CameraPose pose() const { return body_pose ? *body_pose : CameraPose(camera); }
};

/// Cost and detail of a picture.
struct DrawReport {
    std::size_t triangle_count = 0;
    std::size_t node_count = 0;
    double error_px = 0.0;   // of 99 in 100 pixels; see core/view/detail_selection.h
    bool is_complete = true; // shading included; otherwise draw again when notified
    /// Why pieces of it cannot be read at present, so that coarser ones stand in. They are tried
    /// again for as long as they are wanted.
    std::optional<Error> problem{};
};

/// The depths of a picture as a texture, which may have another size than the picture.
struct KeptDepths {
    unsigned texture = 0;
};

/// Draws maps. Every call needs the context current in which the renderer was created, the
/// destructor included. Leaves no program, buffer or vertex array bound.
class TerrainRenderer {
public:
    /// Unsupported where the context is older than OpenGL 3.3 or refuses the shaders. `notify` is
    /// called on another thread when something that was missing in the picture has come; it may be
    /// empty.
    static Result<std::unique_ptr<TerrainRenderer>> create(std::function<void()> notify);

    ~TerrainRenderer();
    TerrainRenderer(const TerrainRenderer&) = delete;
    TerrainRenderer& operator=(const TerrainRenderer&) = delete;

    /// The driver's name for itself: "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& driver() const;
    /// True where the processor does the drawing.
    bool isSoftware() const;

    /// The maps to draw from now on, the uppermost first: where it has a surface, those below have
    /// none. Layers that were there before keep what the driver has of them.
    void setLayers(const std::vector<TerrainLayer>& layers);

    /// The depths between which everything is drawn.
    ClipRange clip(const CameraPose& camera, double exaggeration) const;

    /// Shading is being made that draw() asked for.
    bool isLoading() const;

    /// The load of draw(). Cheap: nothing is drawn.
    std::size_t countTriangles(const DrawRequest& request, double exaggeration);

    /// True if the shading of a picture leaves room for that of another one. Cheap too.
    bool hasRoomFor(const DrawRequest& request, double exaggeration);

    /// Draws into the frame buffer object `target` with what there is. Its depth buffer has 24 bits
    /// and a stencil of 8. It is filled only by pictures that are drawn straight into it: of one
    /// sample a pixel, at scale 1, not kept.
    DrawReport draw(const DrawRequest& request, const DrawStyle& style, unsigned target);
    /// The colors of the last picture that was kept, once more.
    void present(unsigned target);
    /// Copies its depths into an area of `target`, for drawing that the terrain may hide. Copying
    /// all depths takes 4 ms a picture in software, 10 ms if the picture is enlarged.
    void presentDepth(unsigned target, const PixelArea& area);
    /// Its depths, until the next draw().
    KeptDepths keptDepths() const;
    /// Its colors.
    Picture keptColors();
    /// Replaces its colors by those of a picture of the same size.
    void setKeptColors(const Picture& colors);
    /// Returns when what draw() asked for has come, or failed.
    void waitForPending();
    /// As draw(), waiting for all that is missing.
    DrawReport drawComplete(const DrawRequest& request, const DrawStyle& style, unsigned target);

private:
    struct Impl;
    explicit TerrainRenderer(std::unique_ptr<Impl> impl);

    std::unique_ptr<Impl> impl_;
};

} // namespace marsview
