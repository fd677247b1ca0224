// Which tiles the hand will want, by where it goes and how fast tiles can be had.
#pragma once

#include "core/tiles/tile.h"
#include "haptics/terrain/hand_motion.h"
#include "haptics/terrain/resident_window.h"

#include <cstddef>
#include <vector>

namespace marsview {

struct WindowPlanOptions {
    WindowSides sides;
    double lookahead_s = 0.6;   // how far ahead the hand's way is predicted: straight on
    double tiles_per_s = 200.0; // what loaders can do
};

/// What a window should cover and what it should have.
struct WindowPlan {
    std::vector<GridPoint> centres; // of the levels, for ResidentWindow
    std::vector<TileId> tiles;      // the most urgent first; the window covers them all
    /// Finer levels would come too late: the hand has left before they are there.
    std::size_t finest_level = 0;
};

/// Hand first: the tiles under it from coarse to fine, so that what stands in gets better at once;
/// then those around and ahead, by the time at which the hand comes near; from level 3 on, where
/// tiles are few and quickly read, all that the window covers. A pure function.
WindowPlan
planWindow(const TileLayout& layout, const HandMotion& motion, const WindowPlanOptions& options);

} // namespace marsview
