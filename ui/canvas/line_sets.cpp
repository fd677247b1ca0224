#include "ui/canvas/line_sets.h"

#include <utility>

namespace marsview {

std::vector<DrapedLine> graticuleLines(const std::vector<GraticuleLine>& lines)
{
    constexpr double kWidth = 1.0; // points
    constexpr Rgb8 kColor{225, 225, 225};
    std::vector<DrapedLine> draped;
    draped.reserve(lines.size());
    for (const GraticuleLine& line : lines) {
        draped.push_back({.points = line.points,
                          .color = kColor,
                          .width_points = kWidth,
                          .hidden_parts = HiddenParts::Invisible});
    }
    return draped;
}

bool LineSets::set(std::vector<DrapedLine> lines, LineSet set)
{
    std::vector<DrapedLine>& shown = lines_[static_cast<std::size_t>(set)];
    const bool is_change = !lines.empty() || !shown.empty();
    shown = std::move(lines);
    return is_change;
}

void LineSets::paint(TerrainRenderer& terrain,
                     LineRenderer& renderer,
                     const LinePicture& picture,
                     unsigned frame_buffer) const
{
    for (const std::vector<DrapedLine>& lines : lines_) {
        const PixelArea area =
            areaOf(lines, picture.camera, picture.viewport, picture.pixels_per_point);
        if (area.width > 0 && area.height > 0) {
            terrain.presentDepth(frame_buffer, area);
            renderer.draw(lines, picture);
        }
    }
}

void LineSets::draw(LineRenderer& renderer, const LinePicture& picture) const
{
    for (const std::vector<DrapedLine>& lines : lines_) {
        renderer.draw(lines, picture);
    }
}

} // namespace marsview
