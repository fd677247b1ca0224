#include "ui/canvas/line_sets.h"

#include <algorithm>
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

namespace {

// A line without length is a disc.
std::vector<DrapedLine> asLines(const DotSet& set)
{
    std::vector<DrapedLine> lines;
    lines.reserve(set.dots.size());
    for (const TerrainDot& dot : set.dots) {
        lines.push_back({.points = {dot.place, dot.place},
                         .color = dot.color,
                         .width_points = set.width_points});
    }
    return lines;
}

} // namespace

bool LineSets::setDots(DotSet dots, LineSet set)
{
    Dots& shown = dots_[static_cast<std::size_t>(set)];
    const bool is_change = !dots.dots.empty() || !shown.set.dots.empty();
    shown.set = std::move(dots);
    if (is_change) {
        shown.revision = ++revision_;
    }
    return is_change;
}

bool LineSets::set(std::vector<DrapedLine> lines, LineSet set)
{
    std::vector<DrapedLine>& shown = lines_[static_cast<std::size_t>(set)];
    const bool is_change = !lines.empty() || !shown.empty();
    shown = std::move(lines);
    if (is_change) {
        ++revision_;
    }
    return is_change;
}

bool LineSets::isEmpty() const
{
    return std::all_of(lines_.begin(), lines_.end(),
                       [](const auto& lines) { return lines.empty(); }) &&
           std::all_of(dots_.begin(), dots_.end(),
                       [](const Dots& dots) { return dots.set.dots.empty(); });
}

void LineSets::paint(TerrainRenderer& terrain,
                     const LineRenderers& renderers,
                     const LinePicture& picture,
                     unsigned frame_buffer) const
{
    for (std::size_t i = 0; i < kLineSets; ++i) {
        const std::vector<DrapedLine>& lines = lines_[i];
        if (lines.empty() && dots_[i].set.dots.empty()) {
            continue;
        }
        const PixelArea area = renderers.lines.project(lines, picture);
        if (area.width > 0 && area.height > 0) {
            terrain.presentDepth(frame_buffer, area);
            renderers.lines.drawProjected();
        }
        if (!dots_[i].set.dots.empty()) {
            renderers.dots.draw(i, dots_[i].set, dots_[i].revision, picture, terrain.keptDepths());
        }
    }
}

void LineSets::draw(LineRenderer& renderer, const LinePicture& picture) const
{
    for (std::size_t i = 0; i < kLineSets; ++i) {
        renderer.draw(lines_[i], picture);
        if (!dots_[i].set.stamps) {
            renderer.draw(asLines(dots_[i].set), picture);
        }
    }
}

} // namespace marsview
