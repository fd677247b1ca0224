// Drawing lines that lie on the terrain.
#pragma once

#include "core/base/result.h"
#include "core/view/camera.h"
#include "core/view/color_ramp.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace marsview {

/// How parts of a line are drawn that the terrain hides.
enum class HiddenParts { Faint, Invisible };

/// A line through points of the scene. It has the same width on screen at every distance.
struct DrapedLine {
    std::vector<ScenePoint>
        points; // close enough that a straight line between two is on the ground
    Rgb8 color{255, 255, 255};
    double width_points = 2.0; // of the screen, > 0
    HiddenParts hidden_parts = HiddenParts::Faint;
};

/// The picture of the terrain that lines are drawn over.
struct LinePicture {
    CameraPose camera;
    Viewport viewport;
    ClipRange clip; // of the terrain's depths
    double pixels_per_point = 1.0;
    /// The frame buffer holds this part of the viewport alone.
    std::optional<PixelArea> part{};
};

/// Every call needs the context current in which it was created, the destructor included. Leaves no
/// program, buffer or vertex array bound.
class LineRenderer {
public:
    static Result<std::unique_ptr<LineRenderer>> create();
    ~LineRenderer();
    LineRenderer(const LineRenderer&) = delete;
    LineRenderer& operator=(const LineRenderer&) = delete;

    /// Finds where lines are in a picture, for drawProjected(). Returns the part of the picture
    /// that this changes; its width is 0 where that is nothing.
    PixelArea project(std::span<const DrapedLine> lines, const LinePicture& picture);
    /// Draws them over a picture of the terrain in the bound frame buffer, which has that picture's
    /// depths and a stencil of 8 bits where the lines are. A dark border keeps lines visible over
    /// any color. Parts that the terrain hides have no border; they are faint, or not drawn.
    void drawProjected();
    void draw(std::span<const DrapedLine> lines, const LinePicture& picture)
    {
        project(lines, picture);
        drawProjected();
    }

private:
    struct Impl;
    explicit LineRenderer(std::unique_ptr<Impl> impl);

    std::unique_ptr<Impl> impl_;
};

} // namespace marsview
