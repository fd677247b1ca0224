// The terrain as a surface: samples, their scale, and the triangles between them.
#pragma once

#include "core/base/grid_view.h"
#include "core/geo/frames.h"
#include "core/raster/raster_info.h"
#include "core/raster/sample_grid.h"
#include "core/terrain/triangulation.h"

#include <cstddef>
#include <memory>
#include <optional>

namespace marsview {

/// The range of heights in metres.
struct HeightRange {
    double minimum_m = 0.0;
    double maximum_m = 0.0;
};

/// A triangulated surface over a sample grid (triangulation.h). Immutable; any thread. Copies share
/// the samples.
class Heightfield {
public:
    /// The grid has at least 2 × 2 samples.
    Heightfield(std::shared_ptr<const SampleGrid> samples,
                const SampleStatistics& statistics,
                const ElevationScale& scale);

    std::size_t columns() const noexcept { return samples_->columns(); }
    std::size_t rows() const noexcept { return samples_->rows(); }
    const SampleGrid& samples() const noexcept { return *samples_; }
    const ElevationScale& scale() const noexcept { return scale_; }
    /// Nothing where every sample is void.
    const std::optional<HeightRange>& range() const noexcept { return range_; }

    /// Height of a sample in metres; NaN where void. Unchecked: column < columns(), row < rows().
    double sample(std::size_t column, std::size_t row) const noexcept
    {
        return samples_->isVoid(column, row) ? std::numeric_limits<double>::quiet_NaN()
                                             : scale_.height(samples_->raw(column, row));
    }

    CellHeights cell(std::size_t column, std::size_t row) const noexcept
    {
        return {sample(column, row), sample(column + 1, row), sample(column, row + 1),
                sample(column + 1, row + 1)};
    }

    /// Height in metres of the surface at full resolution. NaN outside the outermost samples, in
    /// voids, and for NaN.
    double height(GridPoint grid) const noexcept;

private:
    std::shared_ptr<const SampleGrid> samples_;
    ElevationScale scale_;
    std::optional<HeightRange> range_;
};

} // namespace marsview
