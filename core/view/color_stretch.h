// The stretch of a color ramp: the setting, and the resulting range.
#pragma once

#include "core/terrain/block_means.h"
#include "core/terrain/heightfield.h"

namespace marsview {

enum class StretchKind {
    Automatic,  // all except the extreme 0.5 % at either end
    Full,       // from the lowest to the highest elevation of the map
    Percentile, // all except `cut_percent` at either end
    Fixed,      // from `low` to `high`: typed, or taken from the current view
};

/// The largest percentage that may be cut at either end.
inline constexpr double kStretchCutMax = 45.0;

struct ColorStretch {
    StretchKind kind = StretchKind::Automatic;
    double cut_percent = 2.0; // [0, kStretchCutMax]; Percentile only
    double low = 0.0;         // meters; Fixed only, with low < high
    double high = 0.0;

    bool operator==(const ColorStretch&) const = default;
};

/// From `low` to `high`. Both are finite and low < high.
ColorStretch fixedStretch(double low, double high);

/// Whether two values can be the ends of a ramp: finite, low < high, and further apart than the
/// rounding of doubles of their size.
bool isStretchRange(double low, double high);

/// The data for resolving a stretch.
struct StretchSource {
    const Heightfield& heights;
    const BlockMeans& means; // of `heights`
    HeightRange automatic;   // tintRange() of the map
};

/// The elevations at the ends of the ramp, in meters. Percentiles are those of all samples for a
/// map in memory with at most a million samples, otherwise of block means (BlockMeans). If a
/// percentile leaves a single elevation, or Fixed ends are not a range, the whole range of the map
/// is used. Some 20 ms for a percentile of a large map, otherwise immediate. Any thread.
HeightRange stretchedRange(const ColorStretch& stretch, const StretchSource& source);

} // namespace marsview
