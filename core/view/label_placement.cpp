#include "core/view/label_placement.h"

#include <algorithm>
#include <array>
#include <optional>

namespace marsview {
namespace {

// Positions in order of preference. In reading from left to right, the eye looks for the name of a
// point to its right.
std::array<PixelPoint, 4> middlesFor(const LabelRequest& label, double gap_px)
{
    const PixelPoint p = label.place;
    if (label.anchor == LabelAnchor::Area) {
        const double line = label.height_px + gap_px;
        return {{p, {p.x, p.y + line}, {p.x, p.y - line}, p}};
    }
    const double above = 0.5 * label.height_px + label.clear_px;
    const double aside = 0.5 * label.width_px + label.clear_px;
    return {{{p.x + aside, p.y}, {p.x - aside, p.y}, {p.x, p.y - above}, {p.x, p.y + above}}};
}

class Placement {
public:
    explicit Placement(const LabelLimits& limits)
        : limits_(limits)
    {}

    std::optional<LabelBox> roomFor(const LabelRequest& label) const
    {
        for (const PixelPoint& middle : middlesFor(label, limits_.gap_px)) {
            const LabelBox box{.left = middle.x - 0.5 * label.width_px,
                               .top = middle.y - 0.5 * label.height_px,
                               .right = middle.x + 0.5 * label.width_px,
                               .bottom = middle.y + 0.5 * label.height_px};
            if (isFree(box)) {
                return box;
            }
        }
        return std::nullopt;
    }
    void take(const LabelBox& box)
    {
        const double gap = limits_.gap_px;
        taken_.push_back({box.left - gap, box.top - gap, box.right + gap, box.bottom + gap});
    }

private:
    bool isFree(const LabelBox& box) const
    {
        const auto overlaps = [&box](const LabelBox& other) { return box.overlaps(other); };
        return box.left >= 0.0 && box.top >= 0.0 && box.right <= limits_.viewport.width &&
               box.bottom <= limits_.viewport.height &&
               std::none_of(limits_.obstacles.begin(), limits_.obstacles.end(), overlaps) &&
               std::none_of(taken_.begin(), taken_.end(), overlaps);
    }

    const LabelLimits& limits_;
    std::vector<LabelBox> taken_; // with the gap around them
};

} // namespace

std::vector<PlacedLabel> placeLabels(std::span<const LabelRequest> most_important_first,
                                     const LabelLimits& limits,
                                     const std::function<bool(std::size_t)>& is_wanted)
{
    Placement placement(limits);
    std::vector<PlacedLabel> placed;
    for (std::size_t i = 0; i < most_important_first.size() && placed.size() < limits.count_max;
         ++i) {
        const auto box = placement.roomFor(most_important_first[i]);
        if (box && is_wanted(i)) {
            placement.take(*box);
            placed.push_back({.request = i, .box = *box});
        }
    }
    return placed;
}

} // namespace marsview
