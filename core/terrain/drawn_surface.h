// The heights that drawing uses: those of the samples, and something smooth where there is none.
#pragma once

#include "core/terrain/block_means.h"
#include "core/terrain/heightfield.h"
#include "core/terrain/sample_rows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace marsview {

/// Heights as floats relative to the middle of the map's range, so that they keep millimetres.
/// Void samples have the height that BlockMeans fills in: triangles along the rim of a hole, which
/// are cut there, need one. A function of the sample alone, whatever the detail it is drawn in.
/// A view of both: neither is owned. Any thread.
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
    /// What heights are relative to, in metres.
    double baseMetres() const noexcept { return base_m_; }

    /// Metres over the base; never NaN. Only where the samples are held.
    float height(std::size_t column, std::size_t row) const noexcept
    {
        return heightfield_.samples().isVoid(column, row)
                   ? filled(column, row)
                   : static_cast<float>(heightfield_.sample(column, row) - base_m_);
    }
    /// The heights of heights.size() samples of a row; NaN where void. Only where they are held.
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
