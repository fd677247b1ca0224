// The samples of a raster in memory, in the type of the file.
#pragma once

#include "core/base/grid_view.h"
#include "core/base/result.h"
#include "core/base/scratch_bytes.h"
#include "core/raster/sample_type.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace marsview {

/// Statistics of samples, in raw units (before scale, offset and unit).
struct SampleStatistics {
    double raw_minimum = std::numeric_limits<double>::infinity(); // over samples that are not void
    double raw_maximum = -std::numeric_limits<double>::infinity();
    /// The known values nearest to the minimum and the maximum, other than these: a value that
    /// marks nodata is far from the rest. Infinite if none is known.
    double raw_next_minimum = std::numeric_limits<double>::infinity();
    double raw_next_maximum = -std::numeric_limits<double>::infinity();
    std::uint64_t void_count = 0;
    std::uint64_t sample_count = 0;

    bool hasSamples() const noexcept { return void_count < sample_count; }
    /// Adds a value to the extremes, but not to the counts.
    void includeValue(double raw) noexcept
    {
        includeLow(raw);
        includeHigh(raw);
    }
    void merge(const SampleStatistics& other) noexcept;

private:
    void includeLow(double raw) noexcept;
    void includeHigh(double raw) noexcept;
};

/// The raw values that mean nodata.
struct VoidRule {
    std::optional<double> nodata; // NaN and infinities are always void
};

/// Columns × rows samples in row-major order, kept in the raster's own type: an int16 map takes two
/// bytes per sample, plus one bit if the map has voids. Row 0 is the raster's first.
///
/// Reading concurrently is safe; writing is for the one thread that fills the grid.
class SampleGrid {
public:
    /// Uninitialized samples, none void. A large grid lies where `scratch` says; its samples are 0.
    /// TooLarge if there is no room.
    static Result<SampleGrid> create(SampleType type,
                                     std::size_t columns,
                                     std::size_t rows,
                                     const ScratchPlace* scratch = nullptr);

    SampleType type() const noexcept { return type_; }
    std::size_t columns() const noexcept { return columns_; }
    std::size_t rows() const noexcept { return rows_; }
    /// Memory used, including the void mask.
    std::size_t bytes() const noexcept;

    /// The raw value, void or not. Unchecked: column < columns(), row < rows().
    double raw(std::size_t column, std::size_t row) const noexcept
    {
        const std::size_t index = row * columns_ + column;
        return dispatchSampleType(type_, [&](auto zero) {
            using T = decltype(zero);
            return static_cast<double>(reinterpret_cast<const T*>(samples_.data())[index]);
        });
    }
    bool isVoid(std::size_t column, std::size_t row) const noexcept
    {
        if (!has_voids_) {
            return false;
        }
        const std::size_t word = row * words_per_row_ + column / 64;
        return ((voidWords()[word] >> (column % 64)) & 1U) != 0;
    }
    bool hasVoids() const noexcept { return has_voids_; }

    /// Calls `function(GridView<const T>)` with the samples in their own type.
    template <typename F>
    decltype(auto) visit(F&& function) const
    {
        return dispatchSampleType(type_, [&](auto zero) -> decltype(auto) {
            using T = decltype(zero);
            return std::forward<F>(function)(
                GridView<const T>(reinterpret_cast<const T*>(samples_.data()), columns_, rows_));
        });
    }

    /// The beginning of a row's samples, for writing: columns() × sampleBytes(type()) bytes.
    std::byte* rowData(std::size_t row) noexcept
    {
        return samples_.data() + row * columns_ * sampleBytes(type_);
    }

    void markVoid(std::size_t column, std::size_t row);
    /// Marks the samples of rows [first, first + count) that have one of these raw values.
    void markValues(const std::vector<double>& raw, std::size_t first, std::size_t count);
    /// Marks the samples of rows [first, first + count) that `rule` calls void, and returns what
    /// these rows hold. Samples already marked stay void.
    SampleStatistics applyRule(const VoidRule& rule, std::size_t first, std::size_t count);
    void clearVoids() noexcept;
    /// Copies `part`, with its voids, to this place. The samples there must not be void yet.
    void put(const SampleGrid& part, std::size_t column, std::size_t row);

    bool isInFile() const noexcept { return samples_.isFile(); }
    /// As ScratchBytes::release().
    void releasePages() const noexcept
    {
        samples_.release();
        voids_.release();
    }

private:
    SampleGrid() = default;

    const std::uint64_t* voidWords() const noexcept
    {
        return reinterpret_cast<const std::uint64_t*>(voids_.data());
    }
    std::uint64_t* voidWords() noexcept { return reinterpret_cast<std::uint64_t*>(voids_.data()); }
    std::size_t voidBytes() const noexcept
    {
        return words_per_row_ * rows_ * sizeof(std::uint64_t);
    }

    SampleType type_ = SampleType::Int16;
    std::size_t columns_ = 0;
    std::size_t rows_ = 0;
    ScratchBytes samples_;
    std::size_t words_per_row_ = 0;
    ScratchBytes
        voids_; // one bit per sample, rows padded to words; created when needed, or in a file
    bool has_voids_ = false;
};

} // namespace marsview
