#include "core/terrain/raw_ranges.h"

#include "core/base/check.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <type_traits>
#include <vector>

namespace marsview {
namespace {

template <typename T>
using Range = RawRanges::Range<T>;

template <typename T>
RawArray<std::byte> emptyRanges(std::size_t count)
{
    RawArray<std::byte> bytes(count * sizeof(Range<T>));
    std::fill_n(reinterpret_cast<Range<T>*>(bytes.data()), count, Range<T>{});
    return bytes;
}

// The smallest and largest value of each column over some rows.
template <typename T>
class ColumnRanges {
public:
    explicit ColumnRanges(std::size_t columns)
        : low_(columns)
        , high_(columns)
    {}

    void measure(const SampleGrid& samples,
                 GridView<const T> values,
                 std::size_t first_row,
                 std::size_t last_row)
    {
        std::fill(low_.begin(), low_.end(), std::numeric_limits<T>::max());
        std::fill(high_.begin(), high_.end(), std::numeric_limits<T>::lowest());
        for (std::size_t row = first_row; row <= last_row; ++row) {
            const T* value = values.row(row).data();
            if (!samples.hasVoids()) {
                for (std::size_t i = 0; i < low_.size(); ++i) {
                    low_[i] = value[i] < low_[i] ? value[i] : low_[i];
                    high_[i] = value[i] > high_[i] ? value[i] : high_[i];
                }
                continue;
            }
            for (std::size_t i = 0; i < low_.size(); ++i) {
                if (!samples.isVoid(i, row)) {
                    low_[i] = value[i] < low_[i] ? value[i] : low_[i];
                    high_[i] = value[i] > high_[i] ? value[i] : high_[i];
                }
            }
        }
    }

    Range<T> over(std::size_t first_column, std::size_t last_column) const
    {
        Range<T> range;
        for (std::size_t i = first_column; i <= last_column; ++i) {
            range.include({low_[i], high_[i]});
        }
        return range;
    }

private:
    std::vector<T> low_;
    std::vector<T> high_;
};

// The last sample of a block, which shares it with the next one.
std::size_t lastOf(std::size_t block, std::size_t samples)
{
    return std::min((block + 1) * RawRanges::kBlock, samples - 1);
}

} // namespace

RawRanges::RawRanges(SampleType type, std::size_t sample_columns, std::size_t sample_rows)
    : type_(type)
    , columns_(blocksAlong(sample_columns))
    , rows_(blocksAlong(sample_rows))
    , ranges_(dispatchSampleType(
          type, [&](auto zero) { return emptyRanges<decltype(zero)>(columns_ * rows_); }))
{}

RawRanges
RawRanges::toBeFilled(SampleType type, std::size_t sample_columns, std::size_t sample_rows)
{
    RawRanges ranges;
    ranges.type_ = type;
    ranges.columns_ = blocksAlong(sample_columns);
    ranges.rows_ = blocksAlong(sample_rows);
    ranges.ranges_ = RawArray<std::byte>(ranges.columns_ * ranges.rows_ * 2 * sampleBytes(type));
    return ranges;
}

RawRanges RawRanges::of(const SampleGrid& samples, JobMonitor& monitor)
{
    std::atomic<std::size_t> done{0};
    RawRanges ranges(samples.type(), samples.columns(), samples.rows());
    samples.visit([&](auto values) {
        using T = std::remove_cvref_t<decltype(values(0, 0))>;
        auto* blocks = reinterpret_cast<Range<T>*>(ranges.ranges_.data());
        parallelRanges(ranges.rows_, 4, [&](std::size_t begin, std::size_t end) {
            ColumnRanges<T> columns(samples.columns());
            for (std::size_t row = begin; row < end && !monitor.isCanceled(); ++row) {
                columns.measure(samples, values, row * kBlock, lastOf(row, samples.rows()));
                for (std::size_t i = 0; i < ranges.columns_; ++i) {
                    blocks[row * ranges.columns_ + i] =
                        columns.over(i * kBlock, lastOf(i, samples.columns()));
                }
                monitor.report(static_cast<double>(++done) / static_cast<double>(ranges.rows_));
            }
        });
    });
    return ranges;
}

// The first column and row also belong to the blocks before.
RawRanges::Part::Part(const SampleGrid& samples)
    : type_(samples.type())
    , columns_(blocksAlong(samples.columns()) + 1)
    , rows_(blocksAlong(samples.rows()) + 1)
{
    samples.visit([&](auto values) {
        using T = std::remove_cvref_t<decltype(values(0, 0))>;
        ranges_ = emptyRanges<T>(columns_ * rows_);
        auto* blocks = reinterpret_cast<Range<T>*>(ranges_.data());
        ColumnRanges<T> columns(samples.columns());
        for (std::size_t row = 0; row < rows_; ++row) {
            if (row == 0) {
                columns.measure(samples, values, 0, 0);
            } else {
                columns.measure(samples, values, (row - 1) * kBlock,
                                lastOf(row - 1, samples.rows()));
            }
            blocks[row * columns_] = columns.over(0, 0);
            for (std::size_t i = 1; i < columns_; ++i) {
                blocks[row * columns_ + i] =
                    columns.over((i - 1) * kBlock, lastOf(i - 1, samples.columns()));
            }
        }
    });
}

void RawRanges::include(const Part& part, std::size_t column, std::size_t row)
{
    MARSVIEW_CHECK(part.type_ == type_);
    visit([&](auto blocks) {
        using R = std::remove_cvref_t<decltype(blocks(0, 0))>;
        const auto* added = reinterpret_cast<const R*>(part.ranges_.data());
        for (std::size_t r = row == 0 ? 1 : 0; r < part.rows_; ++r) {
            for (std::size_t c = column == 0 ? 1 : 0; c < part.columns_; ++c) {
                blocks(column + c - 1, row + r - 1).include(added[r * part.columns_ + c]);
            }
        }
    });
}

void RawRanges::clear(std::size_t first, std::size_t end)
{
    visit([&](auto blocks) {
        using R = std::remove_cvref_t<decltype(blocks(0, 0))>;
        for (std::size_t row = first; row < end; ++row) {
            for (R& range : blocks.row(row)) {
                range = R{};
            }
        }
    });
}

SampleStatistics RawRanges::extremes(std::size_t first, std::size_t end) const
{
    return visit([&](auto blocks) {
        SampleStatistics statistics;
        for (std::size_t row = first; row < end; ++row) {
            for (const auto& range : blocks.row(row)) {
                if (!range.isEmpty()) {
                    statistics.includeValue(static_cast<double>(range.minimum));
                    statistics.includeValue(static_cast<double>(range.maximum));
                }
            }
        }
        return statistics;
    });
}

} // namespace marsview
