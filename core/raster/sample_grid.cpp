#include "core/raster/sample_grid.h"

#include "core/raster/nodata.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <new>
#include <type_traits>

namespace marsview {
namespace {

// The two lowest and the two highest distinct values, in the type of the samples: a comparison at
// either end for nearly all of them.
template <typename T>
struct Extremes {
    T low = std::numeric_limits<T>::max();
    T next_low = low;
    T high = std::numeric_limits<T>::lowest();
    T next_high = high;

    void include(T value) noexcept
    {
        if (value < next_low) {
            next_low = value < low ? low : value > low ? value : next_low;
            low = std::min(low, value);
        }
        if (value > next_high) {
            next_high = value > high ? high : value < high ? value : next_high;
            high = std::max(high, value);
        }
    }

    void putInto(SampleStatistics& statistics) const noexcept
    {
        for (const T value : {low, high}) {
            statistics.includeValue(static_cast<double>(value));
        }
        if (low < high) { // otherwise the next ones are not values
            statistics.includeValue(static_cast<double>(next_low));
            statistics.includeValue(static_cast<double>(next_high));
        }
    }
};

// The size limit of an array: the largest difference of two pointers.
constexpr std::size_t kBytesMax =
    static_cast<std::size_t>(std::numeric_limits<std::ptrdiff_t>::max());

template <typename T>
bool isVoidValue(T value, const Nodata<T>& nodata)
{
    if constexpr (std::is_floating_point_v<T>) {
        if (!std::isfinite(value)) {
            return true;
        }
    }
    return nodata.exists && value == nodata.value;
}

} // namespace

std::string_view sampleTypeName(SampleType type)
{
    switch (type) {
    case SampleType::UInt8:
        return "Byte";
    case SampleType::Int8:
        return "Int8";
    case SampleType::UInt16:
        return "UInt16";
    case SampleType::Int16:
        return "Int16";
    case SampleType::UInt32:
        return "UInt32";
    case SampleType::Int32:
        return "Int32";
    case SampleType::UInt64:
        return "UInt64";
    case SampleType::Int64:
        return "Int64";
    case SampleType::Float32:
        return "Float32";
    case SampleType::Float64:
        return "Float64";
    }
    MARSVIEW_CHECK(false);
}

void SampleStatistics::includeLow(double raw) noexcept
{
    if (raw < raw_minimum) {
        raw_next_minimum = raw_minimum;
        raw_minimum = raw;
    } else if (raw > raw_minimum) {
        raw_next_minimum = std::min(raw_next_minimum, raw);
    }
}

void SampleStatistics::includeHigh(double raw) noexcept
{
    if (raw > raw_maximum) {
        raw_next_maximum = raw_maximum;
        raw_maximum = raw;
    } else if (raw < raw_maximum) {
        raw_next_maximum = std::max(raw_next_maximum, raw);
    }
}

void SampleStatistics::merge(const SampleStatistics& other) noexcept
{
    includeLow(other.raw_minimum);
    includeLow(other.raw_next_minimum);
    includeHigh(other.raw_maximum);
    includeHigh(other.raw_next_maximum);
    void_count += other.void_count;
    sample_count += other.sample_count;
}

Result<SampleGrid> SampleGrid::create(SampleType type,
                                      std::size_t columns,
                                      std::size_t rows,
                                      const ScratchPlace* scratch)
{
    MARSVIEW_CHECK(columns > 0 && rows > 0);
    SampleGrid grid;
    grid.type_ = type;
    grid.columns_ = columns;
    grid.rows_ = rows;
    grid.words_per_row_ = (columns + 63) / 64;
    const std::size_t row_bytes = columns * sampleBytes(type);
    const bool is_countable =
        columns <= kBytesMax / sampleBytes(type) && rows <= kBytesMax / row_bytes;
    if (is_countable) {
        // Large pages: a fast stroke crosses a row, and so a page of memory, with every cell. They
        // reduce TLB misses and make the update of a fast stroke 5 % faster.
        auto samples =
            ScratchBytes::create(row_bytes * rows, ScratchBytes::Content::Uninitialized, scratch);
        if (!samples && scratch != nullptr) {
            return std::move(samples).error();
        }
        if (samples) {
            grid.samples_ = std::move(samples).value();
        }
    }
    if (grid.samples_.size() == 0) {
        return Error{ErrorCode::TooLarge,
                     fmt::format("{} × {} samples of {} bytes do not fit in memory", columns, rows,
                                 sampleBytes(type))};
    }
    if (grid.samples_.isFile()) {
        auto voids = ScratchBytes::create(grid.voidBytes(), ScratchBytes::Content::Zeros, scratch);
        if (!voids) {
            return std::move(voids).error();
        }
        grid.voids_ = std::move(voids).value();
    }
    return grid;
}

std::size_t SampleGrid::bytes() const noexcept
{
    return samples_.size() + (has_voids_ ? voids_.size() : 0);
}

void SampleGrid::markVoid(std::size_t column, std::size_t row)
{
    if (voids_.size() == 0) {
        auto voids = ScratchBytes::create(voidBytes(), ScratchBytes::Content::Zeros);
        if (!voids) {
            throw std::bad_alloc();
        }
        voids_ = std::move(voids).value();
    }
    has_voids_ = true;
    voidWords()[row * words_per_row_ + column / 64] |= std::uint64_t{1} << (column % 64);
}

void SampleGrid::clearVoids() noexcept
{
    if (!voids_.isFile()) {
        voids_ = {};
    } else if (has_voids_) {
        std::memset(voids_.data(), 0, voids_.size());
    }
    has_voids_ = false;
}

void SampleGrid::put(const SampleGrid& part, std::size_t column, std::size_t row)
{
    MARSVIEW_CHECK(part.type_ == type_ && column + part.columns_ <= columns_ &&
                   row + part.rows_ <= rows_);
    const std::size_t sample_bytes = sampleBytes(type_);
    for (std::size_t r = 0; r < part.rows_; ++r) {
        std::memcpy(rowData(row + r) + column * sample_bytes,
                    part.samples_.data() + r * part.columns_ * sample_bytes,
                    part.columns_ * sample_bytes);
    }
    for (std::size_t r = 0; part.has_voids_ && r < part.rows_; ++r) {
        for (std::size_t i = 0; i < part.words_per_row_; ++i) {
            const std::uint64_t bits = part.voidWords()[r * part.words_per_row_ + i];
            if (bits == 0) {
                continue;
            }
            const std::size_t first = column + i * 64;
            const auto at = static_cast<std::size_t>(std::countr_zero(bits));
            markVoid(first + at, row + r); // makes the mask
            std::uint64_t* words = voidWords() + (row + r) * words_per_row_ + first / 64;
            words[0] |= bits << (first % 64);
            if (first % 64 != 0 && bits >> (64 - first % 64) != 0) {
                words[1] |= bits >> (64 - first % 64);
            }
        }
    }
}

void SampleGrid::markValues(const std::vector<double>& raw, std::size_t first, std::size_t count)
{
    MARSVIEW_CHECK(first + count <= rows_);
    dispatchSampleType(type_, [&](auto zero) {
        using T = decltype(zero);
        for (const double value : raw) {
            const Nodata<T> mark(value);
            if (!mark.exists) {
                continue;
            }
            const T* samples = reinterpret_cast<const T*>(samples_.data()) + first * columns_;
            for (std::size_t i = 0; i < count * columns_; ++i) {
                if (samples[i] == mark.value) {
                    markVoid(i % columns_, first + i / columns_);
                }
            }
        }
    });
}

SampleStatistics SampleGrid::applyRule(const VoidRule& rule, std::size_t first, std::size_t count)
{
    MARSVIEW_CHECK(first + count <= rows_);
    return dispatchSampleType(type_, [&](auto zero) {
        using T = decltype(zero);
        const Nodata<T> nodata(rule.nodata);
        SampleStatistics statistics;
        statistics.sample_count = count * columns_;
        Extremes<T> found;
        for (std::size_t r = first; r < first + count; ++r) {
            const T* row = reinterpret_cast<const T*>(samples_.data()) + r * columns_;
            for (std::size_t c = 0; c < columns_; ++c) {
                if (isVoidValue(row[c], nodata)) {
                    markVoid(c, r);
                }
                if (isVoid(c, r)) {
                    ++statistics.void_count;
                    continue;
                }
                found.include(row[c]);
            }
        }
        if (statistics.hasSamples()) {
            found.putInto(statistics);
        }
        return statistics;
    });
}

} // namespace marsview
