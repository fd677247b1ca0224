// The lines on the terrain of a view.
#pragma once

#include "core/graticule/graticule_lines.h"
#include "ui/render/dot_renderer.h"
#include "ui/render/line_renderer.h"
#include "ui/render/terrain_renderer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace marsview {

/// Lines that are set together. The later ones are drawn over the others.
enum class LineSet : std::uint8_t { Graticule, Overlays, Selection, Annotations, Measurements };
inline constexpr std::size_t kLineSets = 5;

/// As they are drawn: thin, and only where they are seen.
std::vector<DrapedLine> graticuleLines(const std::vector<GraticuleLine>& lines);

/// What draws lines and dots.
struct LineRenderers {
    LineRenderer& lines;
    DotRenderer& dots;
};

class LineSets {
public:
    /// Replaces the lines of a set. Whether the picture changes.
    bool set(std::vector<DrapedLine> lines, LineSet set);
    /// The same with the dots of a set, which are drawn over its lines.
    bool setDots(DotSet dots, LineSet set);
    const std::vector<DrapedLine>& of(LineSet set) const
    {
        return lines_[static_cast<std::size_t>(set)];
    }
    /// Of all sets; another number after each change.
    std::uint64_t revision() const noexcept { return revision_; }
    bool isEmpty() const;
    /// Draws them over the picture that `terrain` has put into `frame_buffer`, with depths where
    /// lines are.
    void paint(TerrainRenderer& terrain,
               const LineRenderers& renderers,
               const LinePicture& picture,
               unsigned frame_buffer) const;
    /// Over a picture that has its depths; without dots that have stamps.
    void draw(LineRenderer& renderer, const LinePicture& picture) const;

private:
    struct Dots {
        DotSet set;
        std::uint64_t revision = 0;
    };

    std::array<std::vector<DrapedLine>, kLineSets> lines_;
    std::array<Dots, kLineSets> dots_;
    std::uint64_t revision_ = 1;
};

} // namespace marsview
