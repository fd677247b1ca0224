// The path of a hand that swipes across a map, for measurements: deterministic on any machine.
#pragma once

#include "core/geo/frames.h"
#include "core/geo/scene_frame.h"

#include <cstdint>

namespace marsview {

struct SwipeOptions {
    double speed_cells = 1.0; // per update; > 0
    std::uint64_t seed = 1;
};

/// The part of a map to swipe over, in samples.
struct SwipeArea {
    GridPoint first;
    GridPoint last;
};

/// Slightly curved strokes at a constant speed that turn back at the borders and eventually cover
/// the area. A small value for the servo thread: it does not allocate.
class SwipePath {
public:
    SwipePath(const SwipeArea& area, const SwipeOptions& options) noexcept;

    GridPoint at() const noexcept { return at_; }
    /// The position after one more update.
    GridPoint next() noexcept;

private:
    SwipeArea area_;
    SwipeOptions options_;
    std::uint64_t state_;
    GridPoint at_;
    double columns_ = 1.0; // heading, of length 1
    double rows_ = 0.0;
    double turn_ = 0.0;       // per update, radians
    double until_turn_ = 0.0; // cells
};

/// A hand that follows a path and presses: its goal is below the last proxy, by two cells or, if it
/// is fast, by a tenth of its step per update.
class SwipingHand {
public:
    SwipingHand(const SwipePath& path, const SceneFrame& frame, double speed_cells) noexcept;

    /// Deep below the start of the path: places the proxy on the surface there.
    ScenePoint begin() const noexcept;
    ScenePoint next(const ScenePoint& proxy) noexcept;

private:
    SwipePath path_;
    SceneFrame frame_;
    double depth_m_;
};

} // namespace marsview
