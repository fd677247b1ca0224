// Drawing points of the terrain as discs or symbols that keep their size on the screen.
#pragma once

#include "core/base/result.h"
#include "core/geo/frames.h"
#include "core/view/color_ramp.h"
#include "ui/render/line_renderer.h"
#include "ui/render/terrain_renderer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace marsview {

/// Pictures of symbols of one size, made for a screen.
struct DotStamps {
    int side_px = 0; // of each; they are squares, one below the other
    int count = 0;
    /// The sides of the parts in their middle that have all of their pixels: each shorter than
    /// side_px by an even number. Less is drawn.
    std::vector<int> filled_sides_px;
    /// By rows from the top: how much of a pixel has the color of the dot, and how much of it a
    /// black rim over that covers.
    std::vector<std::array<std::uint8_t, 2>> coverage;
};

/// A point of the scene.
struct TerrainDot {
    ScenePoint place;
    Rgb8 color{255, 255, 255};
    std::uint8_t symbol = 0; // of the stamps
};

/// Dots that are drawn together, the later ones over the others.
struct DotSet {
    std::vector<TerrainDot> dots;
    double width_points = 0.0;               // of discs; a dark border is added
    std::shared_ptr<const DotStamps> stamps; // null: the dots are discs
};

/// Every call needs the context current in which it was created, the destructor included. Leaves no
/// program, buffer, texture or vertex array bound.
class DotRenderer {
public:
    static constexpr std::size_t kSlots = 5;

    static Result<std::unique_ptr<DotRenderer>> create();
    ~DotRenderer();
    DotRenderer(const DotRenderer&) = delete;
    DotRenderer& operator=(const DotRenderer&) = delete;

    /// Draws over a picture of the terrain in the bound frame buffer, which has a stencil of 8
    /// bits. Whether the terrain hides a dot is read from the depths of that picture at its center:
    /// a hidden dot is faint. The dots are sent to the driver once for each `revision` of a slot.
    void draw(std::size_t slot,
              const DotSet& set,
              std::uint64_t revision,
              const LinePicture& picture,
              const KeptDepths& depths);

private:
    struct Impl;
    explicit DotRenderer(std::unique_ptr<Impl> impl);

    std::unique_ptr<Impl> impl_;
};

} // namespace marsview
