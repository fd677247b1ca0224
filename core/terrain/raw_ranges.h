// The range of raw values in every block of a map: the source of height bounds at any scale.
#pragma once

#include "core/base/grid_view.h"
#include "core/base/job_monitor.h"
#include "core/base/raw_array.h"
#include "core/raster/sample_grid.h"
#include "core/raster/sample_type.h"

#include <cstddef>
#include <limits>
#include <span>
#include <utility>

namespace marsview {

/// Smallest and largest raw value of the valid samples in each block of kBlock × kBlock cells.
/// Samples on a shared side belong to both blocks. Stored in the type of the samples, so exact.
class RawRanges {
public:
    static constexpr std::size_t kBlock = 32;

    template <typename T>
    struct Range {
        T minimum = std::numeric_limits<T>::max();
        T maximum = std::numeric_limits<T>::lowest();

        bool isEmpty() const noexcept { return !(minimum <= maximum); }
        void include(const Range& other) noexcept
        {
            minimum = other.minimum < minimum ? other.minimum : minimum;
            maximum = other.maximum > maximum ? other.maximum : maximum;
        }
    };

    /// Blocks along an axis with `samples` samples.
    static constexpr std::size_t blocksAlong(std::size_t samples) noexcept
    {
        return (samples - 1 + kBlock - 1) / kBlock;
    }

    RawRanges() = default;
    /// For a map of that many samples; every block is empty.
    RawRanges(SampleType type, std::size_t sample_columns, std::size_t sample_rows);
    /// As above, but uninitialized, to be filled through bytes() or clear().
    static RawRanges
    toBeFilled(SampleType type, std::size_t sample_columns, std::size_t sample_rows);

    /// Of all samples of a map, on all cores. Incomplete if canceled.
    static RawRanges of(const SampleGrid& samples, JobMonitor& monitor);

    /// The ranges of a part of a map. Its first sample must be the upper left one of a block.
    class Part {
    public:
        explicit Part(const SampleGrid& samples);

    private:
        friend class RawRanges;
        SampleType type_;
        std::size_t columns_; // of blocks, including the ones to the left
        std::size_t rows_;    // including the ones above
        RawArray<std::byte> ranges_;
    };
    /// The part's first sample is the first of block (column, row).
    void include(const Part& part, std::size_t column, std::size_t row);

    SampleType type() const noexcept { return type_; }
    std::size_t columns() const noexcept { return columns_; } // of blocks
    std::size_t rows() const noexcept { return rows_; }

    /// Calls `function(GridView<const Range<T>>)`.
    template <typename F>
    decltype(auto) visit(F&& function) const
    {
        return dispatchSampleType(type_, [&](auto zero) -> decltype(auto) {
            using R = Range<decltype(zero)>;
            return std::forward<F>(function)(
                GridView<const R>(reinterpret_cast<const R*>(ranges_.data()), columns_, rows_));
        });
    }
    /// Calls `function(GridView<Range<T>>)`.
    template <typename F>
    decltype(auto) visit(F&& function)
    {
        return dispatchSampleType(type_, [&](auto zero) -> decltype(auto) {
            using R = Range<decltype(zero)>;
            return std::forward<F>(function)(
                GridView<R>(reinterpret_cast<R*>(ranges_.data()), columns_, rows_));
        });
    }

    /// The ranges, row by row: smallest and largest value, alternating.
    std::span<std::byte> bytes() noexcept { return {ranges_.data(), ranges_.size()}; }
    std::span<const std::byte> bytes() const noexcept { return {ranges_.data(), ranges_.size()}; }

    /// Makes the blocks of rows [first, end) empty.
    void clear(std::size_t first, std::size_t end);
    /// Over the blocks of rows [first, end), the next values among those of the blocks; the counts
    /// stay 0.
    SampleStatistics extremes(std::size_t first, std::size_t end) const;
    /// Over all blocks.
    SampleStatistics extremes() const { return extremes(0, rows_); }

private:
    SampleType type_ = SampleType::Int16;
    std::size_t columns_ = 0;
    std::size_t rows_ = 0;
    RawArray<std::byte> ranges_;
};

} // namespace marsview
