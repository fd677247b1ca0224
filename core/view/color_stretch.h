// Over which values a color ramp is spread: the choice, and the range that results.
#pragma once

#include "core/terrain/block_means.h"
#include "core/terrain/heightfield.h"

namespace marsview {

enum class StretchKind {
    Automatic,  // all but the rarest half percent at either end
    Full,       // from the lowest to the highest elevation of the map
    Percentile, // all but `cut_percent` at either end
    Fixed,      // from `low` to `high`: typed, or taken from the current view
};

/// The largest share that may be cut at either end, in percent.
inline constexpr double kStretchCutMax = 45.0;

struct ColorStretch {
    StretchKind kind = StretchKind::Automatic;
    double cut_percent = 2.0; // [0, kStretchCutMax]; Percentile only
    double low = 0.0;         // metres; Fixed only, with low < high
    double high = 0.0;

    bool operator==(const ColorStretch&) const = default;
};

/// From `low` to `high`. Both are finite and low < high.
ColorStretch fixedStretch(double low, double high);

/// Whether a ramp can be spread between two values: finite, low < high, and further apart than
/// the rounding of doubles of their size.
bool isStretchRange(double low, double high);

/// What a stretch is resolved against.
struct StretchSource {
    const Heightfield& heights;
    const BlockMeans& means; // of `heights`
    HeightRange automatic;   // tintRange() of the map
};

/// The elevations at the ends of the ramp, in metres. Percentiles are those of all samples for a
/// map in memory with at most a million samples, otherwise of block means (BlockMeans). A
/// percentile that leaves a single elevation, and Fixed ends that are not a range, give the whole
/// range of the map. Some 20 ms for a percentile of a large map, otherwise immediate. Any thread.
HeightRange stretchedRange(const ColorStretch& stretch, const StretchSource& source);

} // namespace marsview
