// The heights used for drawing: those of the samples, and smooth fills for voids.
#pragma once

#include "core/terrain/block_means.h"
#include "core/terrain/heightfield.h"
#include "core/terrain/sample_rows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace marsview {

/// Heights as floats relative to the middle of the map's range, so that they resolve millimeters.
/// Void samples have the fill height of BlockMeans, because triangles clipped at the rim of a hole
/// need one. The height depends only on the sample, not on the level of detail. A view of both
/// objects: owns neither. Any thread.
class DrawnSurface {
public:
    DrawnSurface(const Heightfield& heightfield, const BlockMeans& means)
        : heightfield_(heightfield)
        , means_(means)
    {
        const HeightRange range = heightfield.range().value_or(HeightRange{});
        base_m_ = (range.minimum_m + range.maximum_m) / 2.0;
    }

    const Heightfield& heightfield() const noexcept { return heightfield_; }
    /// The base of the relative heights, in meters.
    double baseMeters() const noexcept { return base_m_; }

    /// Meters over the base; never NaN. Only if the samples are in memory.
    float height(std::size_t column, std::size_t row) const noexcept
    {
        return heightfield_.samples().isVoid(column, row)
                   ? filled(column, row)
                   : static_cast<float>(heightfield_.sample(column, row) - base_m_);
    }
    /// The heights of heights.size() samples of a row; NaN for voids. Only if the samples are in
    /// memory.
    void read(std::size_t first_column, std::size_t row, std::span<float> heights) const
    {
        readHeights(heightfield_, first_column, row, base_m_, heights);
    }
    /// The height that a void sample is drawn with.
    float filled(std::size_t column, std::size_t row) const noexcept
    {
        return static_cast<float>(static_cast<double>(means_.filled(column, row)) - base_m_);
    }

private:
    const Heightfield& heightfield_;
    const BlockMeans& means_;
    double base_m_ = 0.0;
};

} // namespace marsview
