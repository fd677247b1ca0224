// How a hand swipes across a map, for measuring: the same way every time, on any machine.
#pragma once

#include "core/geo/frames.h"
#include "core/geo/scene_frame.h"

#include <cstdint>

namespace marsview {

struct SwipeOptions {
    double speed_cells = 1.0; // an update; > 0
    std::uint64_t seed = 1;
};

/// The part of a map that is swiped over, in samples.
struct SwipeArea {
    GridPoint first;
    GridPoint last;
};

/// Strokes at a constant speed that curve a little and turn back at the borders; they come
/// everywhere in time. A small value for the servo thread: it allocates nothing.
class SwipePath {
public:
    SwipePath(const SwipeArea& area, const SwipeOptions& options) noexcept;

    GridPoint at() const noexcept { return at_; }
    /// One update later.
    GridPoint next() noexcept;

private:
    SwipeArea area_;
    SwipeOptions options_;
    std::uint64_t state_;
    GridPoint at_;
    double columns_ = 1.0; // heading, of length 1
    double rows_ = 0.0;
    double turn_ = 0.0;       // an update, radians
    double until_turn_ = 0.0; // cells
};

/// A hand that follows a path and presses: its goal is below where the proxy was last, by two cells
/// or, where it is fast, a tenth of its way in an update.
class SwipingHand {
public:
    SwipingHand(const SwipePath& path, const SceneFrame& frame, double speed_cells) noexcept;

    /// Deep below the begin of the path: to place the proxy on the surface there.
    ScenePoint begin() const noexcept;
    ScenePoint next(const ScenePoint& proxy) noexcept;

private:
    SwipePath path_;
    SceneFrame frame_;
    double depth_m_;
};

} // namespace marsview
