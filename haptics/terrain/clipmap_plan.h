// Plans which tiles the hand will need, from its motion and the loaders' throughput.
#pragma once

#include "core/tiles/tile.h"
#include "haptics/terrain/clipmap.h"
#include "haptics/terrain/hand_motion.h"

#include <cstddef>
#include <vector>

namespace marsview {

struct WindowPlanOptions {
    WindowSides sides;
    double lookahead_s = 0.6;   // prediction horizon of the hand's straight path
    double tiles_per_s = 200.0; // throughput of the loaders
};

/// What a window should cover, and the tiles to request.
struct ClipmapPlan {
    std::vector<GridPoint> centers; // of the levels, for Clipmap
    std::vector<TileId> tiles;      // the most urgent first; all covered by the window
    /// Finer levels would arrive too late, after the hand has passed.
    std::size_t finest_level = 0;
};

/// The tiles under the hand come first, from coarse to fine, so that coarse replacements are
/// refined at once; then the tiles around and ahead, by the time until the hand is near; from level
/// 3 on, where tiles are few and quick to read, all that the window covers. A pure function.
ClipmapPlan
planWindow(const TileLayout& layout, const HandMotion& motion, const WindowPlanOptions& options);

} // namespace marsview
