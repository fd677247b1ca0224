// The terrain as a surface: samples, their scale, and the triangles between them.
#pragma once

#include "core/base/grid_view.h"
#include "core/geo/frames.h"
#include "core/raster/raster_info.h"
#include "core/raster/sample_grid.h"
#include "core/terrain/tiled_samples.h"
#include "core/terrain/triangulation.h"

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>

namespace marsview {

/// The range of heights in meters.
struct HeightRange {
    double minimum_m = 0.0;
    double maximum_m = 0.0;
};

/// The height range of the scanned samples; empty if every sample is void.
std::optional<HeightRange> heightRange(const SampleStatistics& statistics,
                                       const ElevationScale& scale);

/// A triangulated surface (triangulation.h) over samples in memory, or over tiles of which some are
/// in memory. Any thread; a tiled one not on the servo thread. Immutable, except that a tiled one
/// uses coarser levels until the finest tiles are resident. Copies share the samples.
class Heightfield {
public:
    /// The grid has at least 2 × 2 samples.
    Heightfield(std::shared_ptr<const SampleGrid> samples,
                const SampleStatistics& statistics,
                const ElevationScale& scale);
    Heightfield(std::shared_ptr<const TiledSamples> tiles,
                const SampleStatistics& statistics,
                const ElevationScale& scale);

    /// The same samples at another scale.
    Heightfield scaled(const SampleStatistics& statistics, const ElevationScale& scale) const
    {
        return isTiled() ? Heightfield(tiles_, statistics, scale)
                         : Heightfield(samples_, statistics, scale);
    }

    std::size_t columns() const noexcept
    {
        return samples_ ? samples_->columns() : tiles_->layout().columns;
    }
    std::size_t rows() const noexcept
    {
        return samples_ ? samples_->rows() : tiles_->layout().rows;
    }
    bool hasVoids() const noexcept
    {
        return samples_ ? samples_->hasVoids() : tiles_->layout().has_voids;
    }
    /// Whether the samples are tiled.
    bool isTiled() const noexcept { return samples_ == nullptr; }
    /// All samples. Only if isTiled() is false.
    const SampleGrid& samples() const noexcept
    {
        MARSVIEW_CHECK(samples_ != nullptr);
        return *samples_;
    }
    /// Only if isTiled().
    const std::shared_ptr<const TiledSamples>& tiles() const noexcept
    {
        MARSVIEW_CHECK(tiles_ != nullptr);
        return tiles_;
    }
    const ElevationScale& scale() const noexcept { return scale_; }
    /// Empty if every sample is void.
    const std::optional<HeightRange>& range() const noexcept { return range_; }

    /// Height of a sample in meters; NaN if void. Unchecked: column < columns(), row < rows().
    double sample(std::size_t column, std::size_t row) const
    {
        if (!samples_) {
            return tiledSample(column, row);
        }
        return samples_->isVoid(column, row) ? std::numeric_limits<double>::quiet_NaN()
                                             : scale_.height(samples_->raw(column, row));
    }

    CellHeights cell(std::size_t column, std::size_t row) const
    {
        return {sample(column, row), sample(column + 1, row), sample(column, row + 1),
                sample(column + 1, row + 1)};
    }

    /// Height in meters of the surface at full resolution. NaN outside the outermost samples, in
    /// voids, and for NaN. On a tiled map, missing tiles are requested; see isExact().
    double height(GridPoint grid) const;
    /// As height(), but without requesting missing tiles: for transient queries.
    double heightNow(GridPoint grid) const;
    /// Whether these functions use full resolution now: always true for samples in memory.
    bool isExact(GridPoint grid) const;
    /// As height(), but waits for missing tiles. NaN if they cannot be read;
    /// tiles()->raster().failure() then gives the reason.
    double heightWaiting(GridPoint grid) const;

private:
    double tiledSample(std::size_t column, std::size_t row) const;

    std::shared_ptr<const SampleGrid> samples_; // null if tiles_ is set
    std::shared_ptr<const TiledSamples> tiles_;
    ElevationScale scale_;
    std::optional<HeightRange> range_;
};

} // namespace marsview
