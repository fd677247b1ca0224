// The lines on the terrain of a view.
#pragma once

#include "core/graticule/graticule_lines.h"
#include "ui/render/line_renderer.h"
#include "ui/render/terrain_renderer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace marsview {

/// Lines that are set together. The later ones are drawn over the others.
enum class LineSet : std::uint8_t { Graticule, Overlays, Annotations, Measurements };
inline constexpr std::size_t kLineSets = 4;

/// As they are drawn: thin, and only where they are seen.
std::vector<DrapedLine> graticuleLines(const std::vector<GraticuleLine>& lines);

class LineSets {
public:
    /// Replaces the lines of a set. Whether the picture changes.
    bool set(std::vector<DrapedLine> lines, LineSet set);
    const std::vector<DrapedLine>& of(LineSet set) const
    {
        return lines_[static_cast<std::size_t>(set)];
    }
    /// Draws them over the picture that `terrain` has put into `frame_buffer`, with depths where
    /// lines are.
    void paint(TerrainRenderer& terrain,
               LineRenderer& renderer,
               const LinePicture& picture,
               unsigned frame_buffer) const;
    /// Over a picture that has its depths.
    void draw(LineRenderer& renderer, const LinePicture& picture) const;

private:
    std::array<std::vector<DrapedLine>, kLineSets> lines_;
};

} // namespace marsview
