// The slope range of color ramps.
#pragma once

#include "core/base/angle.h"
#include "core/terrain/relief_tile.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace marsview {

/// The slopes at the two ends of a color ramp, from level ground up. True slopes: the exaggeration
/// of the view does not change them.
struct SlopeRange {
    Angle minimum{};
    Angle maximum = Angle::degrees(40.0);
    bool operator==(const SlopeRange&) const = default;
};

/// The default range for a map: from 0 to a round number (1, 1.5, 2, 3, 4, 5, 6 or 8 × 10^n
/// degrees, at least 0.1° and at most 90°) that 99 % of the texels of `whole`, the relief of the
/// whole map, do not exceed. `columns` and `rows` are the texels of the tile that lie on the map,
/// without its border; `slope_max` is that of the relief. Any thread.
SlopeRange
slopeRange(const ReliefTile& whole, std::size_t columns, std::size_t rows, double slope_max);

/// How the slopes of a map are distributed.
struct SlopeHistogram {
    Angle maximum{};                     // of the steepest texel
    std::vector<std::uint64_t> counts{}; // of texels, in equal parts from 0 to `maximum`
};

/// Of the same texels. Without counts where all of them are void. Any thread.
SlopeHistogram slopeHistogram(const ReliefTile& whole,
                              std::size_t columns,
                              std::size_t rows,
                              double slope_max,
                              std::size_t bin_count = 64);

} // namespace marsview
