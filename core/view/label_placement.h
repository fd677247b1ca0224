// Where labels go in a picture, so that none lies over another.
#pragma once

#include "core/view/camera.h"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace marsview {

/// A rectangle in a picture, in pixels: x right, y down.
struct LabelBox {
    double left = 0.0;
    double top = 0.0;
    double right = 0.0;
    double bottom = 0.0;

    /// Whether the insides have a point in common.
    bool overlaps(const LabelBox& other) const noexcept
    {
        return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
};

/// What a label belongs to.
enum class LabelAnchor {
    Area,  // the label lies over the middle of an area, or a little above or below it
    Point, // the label lies next to a point, which it does not cover
};

struct LabelRequest {
    PixelPoint place{};
    double width_px = 0.0;
    double height_px = 0.0;
    LabelAnchor anchor = LabelAnchor::Area;
    double clear_px = 0.0; // between a point and its label
};

struct LabelLimits {
    Viewport viewport{};
    double gap_px = 0.0;                      // kept free between labels
    std::size_t count_max = 0;                // of labels that are placed
    std::span<const LabelBox> obstacles = {}; // where no label may be
};

struct PlacedLabel {
    std::size_t request = 0; // its index
    LabelBox box{};
};

/// Places labels one after the other, the most important first; one that has no room is left out.
/// All boxes are whole inside the picture, at least `gap_px` apart and clear of obstacles. Before a
/// label takes room, `is_wanted` is asked for it, which may be slow: whether its place is visible,
/// for example. A pure function of its arguments. O(requests × labels placed).
std::vector<PlacedLabel> placeLabels(std::span<const LabelRequest> most_important_first,
                                     const LabelLimits& limits,
                                     const std::function<bool(std::size_t request)>& is_wanted);

} // namespace marsview
