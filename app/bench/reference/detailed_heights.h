// Enlarges a measured map with synthetic detail below its resolution.
#pragma once

#include "core/base/grid_view.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace marsview {

struct DetailedHeightsOptions {
    std::size_t columns = 0; // of the larger map, at least 2 × 2
    std::size_t rows = 0;
    std::uint64_t seed = 1;
    bool wraps_around = false; // the first column follows the last one
};

/// The surface through a map's samples (Catmull-Rom splines) at another size over the same extent,
/// plus fractal noise narrower than a sample. The noise continues the map's spectrum: its
/// amplitudes follow the power law by which the map's own height differences decrease with
/// distance, and its roughness follows the surrounding terrain, measured by the map's second
/// differences along columns: plains stay smooth, and so do straight slopes.
///
/// Every sample is a function of its position, the map and the seed: any window computed alone has
/// the same bits, on every machine. Immutable; any thread.
class DetailedHeights {
public:
    /// `heights_m` has no NaN and at least 4 × 4 samples.
    DetailedHeights(GridView<const float> heights_m, const DetailedHeightsOptions& options);

    std::size_t columns() const noexcept { return across_.index.size(); }
    std::size_t rows() const noexcept { return down_.index.size(); }
    /// Octaves of noise; 0 if the map is hardly enlarged.
    std::size_t octaveCount() const noexcept { return octave_gain_.size(); }
    /// The ratio of root mean square height differences over half a distance to those over the
    /// distance.
    double halvingRatio() const noexcept { return halving_ratio_; }

    /// Whole meters, within int16, from (column, row) on; the window must lie within the map.
    /// Allocates.
    void window(std::size_t column, std::size_t row, GridView<std::int16_t> heights_m) const;

private:
    // The positions of an axis's samples between those of the map.
    struct Axis {
        std::vector<std::int32_t> index; // of the preceding map sample; may be -1
        std::vector<float> fraction;     // distance from it, in [0, 1)
    };
    struct Block;
    static Axis axisOf(std::size_t count, std::size_t source_count);

    void measure();
    void block(std::size_t column, std::size_t row, GridView<std::int16_t> heights_m) const;
    void noise(std::int64_t column,
               std::int64_t row,
               std::size_t columns,
               std::size_t rows,
               Block& block) const;

    std::size_t source_columns_;
    std::size_t source_rows_;
    std::uint64_t seed_;
    bool wraps_around_;
    std::vector<float> source_m_;
    std::vector<float> roughness_m_; // height differences over a sample, root mean square
    Axis across_;
    Axis down_;
    double halving_ratio_ = 0.0;
    std::vector<float> octave_gain_; // times the roughness; octave k has a lattice of 2^k samples
};

} // namespace marsview
