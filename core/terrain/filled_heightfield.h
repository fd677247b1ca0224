// The surface without holes, which can be touched everywhere.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/terrain/fill_range.h"
#include "core/terrain/heightfield.h"
#include "core/terrain/surface_analysis.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// A heightfield whose void samples have the fill height of BlockMeans, within the range of the
/// map, so that the touched and the drawn surface agree at the rim of a hole. Valid samples keep
/// their height to the bit. Immutable; any thread. Shares the samples and the analysis; with voids
/// it also stores a bound for each node.
class FilledHeightfield {
public:
    /// `analysis` must be that of `heightfield`. Reads every sample once if any is void. The only
    /// error is Canceled.
    static Result<FilledHeightfield> build(const Heightfield& heightfield,
                                           std::shared_ptr<const SurfaceAnalysis> analysis,
                                           JobMonitor& monitor);

    /// Computes the bounds of all levels of the pyramid's nodes from those of its blocks.
    static std::vector<std::vector<float>> maximaFrom(std::vector<float> blocks_m,
                                                      const MinMaxPyramid& pyramid);

    std::size_t columns() const noexcept { return heightfield_.columns(); }
    std::size_t rows() const noexcept { return heightfield_.rows(); }
    const Heightfield& heightfield() const noexcept { return heightfield_; }

    bool isVoid(std::size_t column, std::size_t row) const noexcept
    {
        return heightfield_.samples().isVoid(column, row);
    }
    /// In meters, never NaN. Unchecked: column < columns(), row < rows(). Allocates nothing.
    double sample(std::size_t column, std::size_t row) const noexcept
    {
        return isVoid(column, row)
                   ? static_cast<double>(fillAt(column, row))
                   : heightfield_.scale().height(heightfield_.samples().raw(column, row));
    }
    /// The bits of the raw value of all void samples, if they have one in common: samples with
    /// other bits are not void. Empty without voids.
    const std::optional<std::uint64_t>& voidBits() const noexcept { return void_bits_; }
    CellHeights cell(std::size_t column, std::size_t row) const noexcept
    {
        return {sample(column, row), sample(column + 1, row), sample(column, row + 1),
                sample(column + 1, row + 1)};
    }

    /// The nodes of the hierarchy are those of MinMaxPyramid.
    std::size_t levelCount() const noexcept { return analysis_->bounds.levelCount(); }
    /// Upper bound of the node's filled samples, in meters.
    double maximum(std::size_t level, std::size_t column, std::size_t row) const noexcept
    {
        return static_cast<double>(
            maxima_.empty() ? analysis_->bounds.bounds(level, column, row).maximum_m
                            : maxima_[level][row * analysis_->bounds.columns(level) + column]);
    }

private:
    FilledHeightfield(const Heightfield& heightfield,
                      std::shared_ptr<const SurfaceAnalysis> analysis)
        : heightfield_(heightfield)
        , analysis_(std::move(analysis))
        , range_(heightfield.range())
    {}

    float fillAt(std::size_t column, std::size_t row) const noexcept;
    bool buildMaxima(JobMonitor& monitor);

    Heightfield heightfield_;
    std::shared_ptr<const SurfaceAnalysis> analysis_;
    FillRange range_;
    // One array per level, as in the analysis' bounds; empty without voids.
    std::vector<std::vector<float>> maxima_;
    std::optional<std::uint64_t> void_bits_;
};

} // namespace marsview
