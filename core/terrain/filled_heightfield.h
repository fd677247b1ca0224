// The surface without holes: what a hand can touch everywhere.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/terrain/heightfield.h"
#include "core/terrain/surface_analysis.h"

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace marsview {

/// A heightfield whose void samples have a height too: that which BlockMeans fills in, within the
/// range of the map, so that the hand finds what the eye sees at the rim of a hole. Samples that
/// are not void keep theirs to the bit. Immutable; any thread. Shares the samples and the analysis;
/// with voids it holds a bound for each node besides.
class FilledHeightfield {
    // Calls `function(at)`, where at(column, row) is a sample's height. The type of the samples is
    // looked up once, which for the servo thread is half the cost of reading them.
    template <typename F>
    auto read(F&& function) const noexcept
    {
        const SampleGrid& samples = heightfield_.samples();
        if (samples.hasVoids()) {
            return function([this](std::size_t c, std::size_t r) { return sample(c, r); });
        }
        return samples.visit([&](auto view) {
            const ElevationScale scale = heightfield_.scale();
            return function([&](std::size_t c, std::size_t r) {
                return scale.height(static_cast<double>(view(c, r)));
            });
        });
    }

public:
    /// `analysis` was made from `heightfield`. Looks at every sample once, if any is void. Only
    /// Cancelled can go wrong.
    static Result<FilledHeightfield> build(const Heightfield& heightfield,
                                           std::shared_ptr<const SurfaceAnalysis> analysis,
                                           JobMonitor& monitor);

    std::size_t columns() const noexcept { return heightfield_.columns(); }
    std::size_t rows() const noexcept { return heightfield_.rows(); }
    const Heightfield& heightfield() const noexcept { return heightfield_; }

    bool isVoid(std::size_t column, std::size_t row) const noexcept
    {
        return heightfield_.samples().isVoid(column, row);
    }
    /// In metres, never NaN. Unchecked: column < columns(), row < rows(). Allocates nothing.
    double sample(std::size_t column, std::size_t row) const noexcept
    {
        return isVoid(column, row)
                   ? fillAt(column, row)
                   : heightfield_.scale().height(heightfield_.samples().raw(column, row));
    }
    CellHeights cell(std::size_t column, std::size_t row) const noexcept
    {
        return read([&](const auto& at) -> CellHeights {
            return {at(column, row), at(column + 1, row), at(column, row + 1),
                    at(column + 1, row + 1)};
        });
    }
    /// A sample and those of its neighbours that are joined to it by an edge of the triangulation:
    /// itself, right, right below, below, left, left above, above. The rows and columns beside it
    /// are the caller's, so that it decides what lies beyond the border.
    std::array<double, 7> sevenSamples(std::size_t column,
                                       std::size_t row,
                                       std::size_t left,
                                       std::size_t right,
                                       std::size_t above,
                                       std::size_t below) const noexcept
    {
        return read([&](const auto& at) -> std::array<double, 7> {
            return {at(column, row), at(right, row),  at(right, below), at(column, below),
                    at(left, row),   at(left, above), at(column, above)};
        });
    }

    /// The nodes of the hierarchy are those of MinMaxPyramid.
    std::size_t levelCount() const noexcept { return analysis_->bounds.levelCount(); }
    /// No filled sample of the node is higher; in metres.
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
        , range_(heightfield.range().value_or(HeightRange{}))
    {}

    double fillAt(std::size_t column, std::size_t row) const noexcept;
    bool buildMaxima(JobMonitor& monitor);

    Heightfield heightfield_;
    std::shared_ptr<const SurfaceAnalysis> analysis_;
    HeightRange range_;
    // A level each, as in the analysis' bounds; empty where no sample is void.
    std::vector<std::vector<float>> maxima_;
};

} // namespace marsview
