#include "core/prepare/overview_builder.h"

#include "core/base/check.h"
#include "core/raster/nodata.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace marsview {
namespace {

// Integers of up to 32 bits are summed exactly: at most 2^40 of them.
template <typename T>
using SumOf = std::conditional_t<std::is_integral_v<T> && sizeof(T) <= 4, std::int64_t, double>;

template <typename T>
T voidSample(const Nodata<T>& nodata)
{
    if (nodata.exists) {
        return nodata.value;
    }
    if constexpr (std::is_floating_point_v<T>) {
        return std::numeric_limits<T>::quiet_NaN();
    }
    return T{};
}

template <typename T>
T neighborOf(T value)
{
    if constexpr (std::is_floating_point_v<T>) {
        return std::nextafter(value, value != T{} ? T{} : std::numeric_limits<T>::max());
    } else {
        return value == std::numeric_limits<T>::max() ? static_cast<T>(value - 1)
                                                      : static_cast<T>(value + 1);
    }
}

template <typename T, typename Sum>
T meanOf(Sum sum, std::uint64_t count)
{
    const double mean = static_cast<double>(sum) / static_cast<double>(count);
    constexpr double kLow = static_cast<double>(std::numeric_limits<T>::lowest());
    constexpr double kHigh = static_cast<double>(std::numeric_limits<T>::max());
    if (mean <= kLow) {
        return std::numeric_limits<T>::lowest();
    }
    if (mean >= kHigh) {
        return std::numeric_limits<T>::max();
    }
    if constexpr (std::is_floating_point_v<T>) {
        return static_cast<T>(mean);
    } else {
        return static_cast<T>(mean < 0.0 ? mean - 0.5 : mean + 0.5); // halves away from zero
    }
}

// Halves a field of sums in place; an odd last column or row is kept alone.
template <typename Sum>
void halve(Sum* sums, std::uint64_t* counts, std::size_t& width, std::size_t& height)
{
    const std::size_t half_width = (width + 1) / 2;
    const std::size_t half_height = (height + 1) / 2;
    for (std::size_t y = 0; y < half_height; ++y) {
        for (std::size_t x = 0; x < half_width; ++x) {
            Sum sum{};
            std::uint64_t count = 0;
            for (std::size_t v = 2 * y; v < std::min(2 * y + 2, height); ++v) {
                for (std::size_t u = 2 * x; u < std::min(2 * x + 2, width); ++u) {
                    sum += sums[v * width + u];
                    count += counts[v * width + u];
                }
            }
            sums[y * half_width + x] = sum; // never overwrites sums still to be read
            counts[y * half_width + x] = count;
        }
    }
    width = half_width;
    height = half_height;
}

template <typename Sum>
std::uint64_t bitsOf(Sum sum)
{
    return std::bit_cast<std::uint64_t>(sum);
}

} // namespace

std::size_t overviewCount(std::size_t columns, std::size_t rows)
{
    std::size_t count = 0;
    while (TileLayout::samplesAlong(TileKind::Means, count, columns) > kTileSide ||
           TileLayout::samplesAlong(TileKind::Means, count, rows) > kTileSide) {
        ++count;
    }
    return count;
}

OverviewBuilder::OverviewBuilder(std::size_t columns,
                                 std::size_t rows,
                                 SampleType type,
                                 const std::optional<double>& nodata,
                                 bool has_mask)
    : type_(type)
    , nodata_(nodata)
    , has_mask_(has_mask)
    , columns_(columns)
    , rows_(rows)
    , tile_columns_((columns + kTileSide - 1) / kTileSide)
    , levels_(overviewCount(columns, rows))
{
    for (std::size_t i = 0; i < levels_.size(); ++i) {
        Level& level = levels_[i];
        level.columns = TileLayout::samplesAlong(TileKind::Means, i + 1, columns);
        level.rows = TileLayout::samplesAlong(TileKind::Means, i + 1, rows);
    }
    if (levels_.size() > kStreamedLevels) {
        const std::size_t tiles = tile_columns_ * ((rows + kTileSide - 1) / kTileSide);
        sum_bits_.resize(tiles);
        counts_.resize(tiles);
    }
}

Status OverviewBuilder::makeRoom(const ScratchPlace* scratch)
{
    for (std::size_t i = 0; i < std::min(levels_.size(), kStreamedLevels); ++i) {
        Level& level = levels_[i];
        const std::size_t pixels = level.columns * kTileSide;
        auto samples = ScratchBytes::create(pixels * sampleBytes(type_),
                                            ScratchBytes::Content::Zeros, scratch);
        auto valid =
            ScratchBytes::create(has_mask_ ? pixels : 0, ScratchBytes::Content::Zeros, scratch);
        if (!samples || !valid) {
            return samples ? std::move(valid).error() : std::move(samples).error();
        }
        level.samples = std::move(samples).value();
        level.valid = std::move(valid).value();
    }
    return Done{};
}

void OverviewBuilder::release() const noexcept
{
    for (const Level& level : levels_) {
        level.samples.release();
        level.valid.release();
    }
}

template <typename T, typename Sum>
void OverviewBuilder::putPixels(Level& level,
                                std::size_t column,
                                std::size_t row,
                                std::size_t width,
                                std::size_t height,
                                const Sum* sums,
                                const std::uint64_t* counts)
{
    const Nodata<T> nodata(nodata_);
    const T void_sample = voidSample(nodata);
    for (std::size_t y = 0; y < height; ++y) {
        auto* const samples =
            reinterpret_cast<T*>(level.samples.data()) + (row + y) * level.columns + column;
        for (std::size_t x = 0; x < width; ++x) {
            const std::uint64_t count = counts[y * width + x];
            T value = void_sample;
            if (count > 0) {
                value = meanOf<T>(sums[y * width + x], count);
                if (nodata.exists && value == nodata.value) {
                    value = neighborOf(value);
                }
            }
            samples[x] = value;
        }
        if (has_mask_) {
            auto* const valid = reinterpret_cast<std::uint8_t*>(level.valid.data()) +
                                (row + y) * level.columns + column;
            for (std::size_t x = 0; x < width; ++x) {
                valid[x] = counts[y * width + x] > 0 ? 1 : 0;
            }
        }
    }
}

template <typename T>
void OverviewBuilder::addSamples(GridView<const T> samples,
                                 const SampleGrid& grid,
                                 std::size_t grid_row,
                                 std::size_t tile_column,
                                 std::size_t tile_row)
{
    using Sum = SumOf<T>;
    const std::size_t first = tile_column * kTileSide;
    const std::size_t samples_wide = std::min(kTileSide, columns_ - first);
    const std::size_t samples_high = std::min(kTileSide, rows_ - tile_row * kTileSide);
    std::size_t width = (samples_wide + 1) / 2;
    std::size_t height = (samples_high + 1) / 2;
    std::vector<Sum> sums(width * height);
    std::vector<std::uint64_t> counts(width * height);
    for (std::size_t y = 0; y < samples_high; ++y) {
        const T* const row = samples.row(grid_row + y).data() + first;
        Sum* const row_sums = sums.data() + y / 2 * width;
        std::uint64_t* const row_counts = counts.data() + y / 2 * width;
        if (grid.hasVoids()) {
            for (std::size_t x = 0; x < samples_wide; ++x) {
                if (!grid.isVoid(first + x, grid_row + y)) {
                    row_sums[x / 2] += static_cast<Sum>(row[x]);
                    ++row_counts[x / 2];
                }
            }
            continue;
        }
        for (std::size_t x = 0; x < samples_wide / 2; ++x) {
            row_sums[x] += static_cast<Sum>(row[2 * x]) + static_cast<Sum>(row[2 * x + 1]);
            row_counts[x] += 2;
        }
        if (samples_wide % 2 != 0) {
            row_sums[width - 1] += static_cast<Sum>(row[samples_wide - 1]);
            row_counts[width - 1] += 1;
        }
    }
    const std::size_t streamed = std::min(levels_.size(), kStreamedLevels);
    for (std::size_t k = 1; k <= streamed; ++k) {
        const std::size_t side = kTileSide >> k; // pixels of this level in a tile of the raster
        putPixels<T>(levels_[k - 1], tile_column * side, tile_row % (std::size_t{1} << k) * side,
                     width, height, sums.data(), counts.data());
        if (k < streamed) {
            halve(sums.data(), counts.data(), width, height);
        }
    }
    if (!sum_bits_.empty()) {
        sum_bits_[tile_row * tile_columns_ + tile_column] = bitsOf(sums.front());
        counts_[tile_row * tile_columns_ + tile_column] = counts.front();
    }
}

void OverviewBuilder::addTile(const SampleGrid& grid,
                              std::size_t grid_row,
                              std::size_t tile_column,
                              std::size_t tile_row)
{
    MARSVIEW_CHECK(grid.columns() == columns_ && grid.type() == type_);
    if (levels_.empty()) {
        return;
    }
    MARSVIEW_CHECK(levels_[0].samples.size() > 0);
    grid.visit([&]<typename T>(GridView<const T> samples) {
        addSamples<T>(samples, grid, grid_row, tile_column, tile_row);
    });
}

OverviewBuilder::Rows OverviewBuilder::rowsOf(std::size_t level, std::size_t tile_row) const
{
    MARSVIEW_CHECK(level >= 1 && level <= std::min(levels_.size(), kStreamedLevels));
    const Level& of = levels_[level - 1];
    const std::size_t first = (tile_row >> level) * kTileSide;
    return {.samples = of.samples.data(),
            .valid = reinterpret_cast<const std::uint8_t*>(of.valid.data()),
            .columns = of.columns,
            .rows = std::min(kTileSide, of.rows - first),
            .samples_in = &of.samples,
            .valid_in = &of.valid};
}

OverviewBuilder::Rows OverviewBuilder::makeLevel(std::size_t level)
{
    MARSVIEW_CHECK(level == made_level_ + 1 && level <= levels_.size());
    if (made_level_ == kStreamedLevels) {
        made_columns_ = tile_columns_;
        made_rows_ = sum_bits_.size() / tile_columns_;
    }
    made_level_ = level;
    Level& made = levels_[level - 1];
    const std::size_t pixels = made.columns * made.rows;
    made.samples =
        ScratchBytes::create(pixels * sampleBytes(type_), ScratchBytes::Content::Zeros).value();
    made.valid = ScratchBytes::create(has_mask_ ? pixels : 0, ScratchBytes::Content::Zeros).value();
    dispatchSampleType(type_, [&](auto zero) {
        using T = decltype(zero);
        using Sum = SumOf<T>;
        std::vector<Sum> sums(sum_bits_.size());
        std::transform(sum_bits_.begin(), sum_bits_.end(), sums.begin(),
                       [](std::uint64_t bits) { return std::bit_cast<Sum>(bits); });
        halve(sums.data(), counts_.data(), made_columns_, made_rows_);
        sums.resize(made_columns_ * made_rows_);
        counts_.resize(sums.size());
        sum_bits_.resize(sums.size());
        std::transform(sums.begin(), sums.end(), sum_bits_.begin(), bitsOf<Sum>);
        MARSVIEW_CHECK(made_columns_ == made.columns && made_rows_ == made.rows);
        putPixels<T>(made, 0, 0, made.columns, made.rows, sums.data(), counts_.data());
    });
    return {.samples = made.samples.data(),
            .valid = reinterpret_cast<const std::uint8_t*>(made.valid.data()),
            .columns = made.columns,
            .rows = made.rows};
}

OverviewBuilder::TileSums OverviewBuilder::sumsOf(std::size_t first_tile_row,
                                                  std::size_t end_tile_row)
{
    if (sum_bits_.empty()) {
        return {};
    }
    const std::size_t first = first_tile_row * tile_columns_;
    const std::size_t count = end_tile_row * tile_columns_ - first;
    return {std::span(sum_bits_).subspan(first, count), std::span(counts_).subspan(first, count)};
}

template <typename Function>
void OverviewBuilder::forEachPending(std::size_t tile_rows, Function&& function)
{
    for (std::size_t k = 1; k <= std::min(levels_.size(), kStreamedLevels); ++k) {
        Level& level = levels_[k - 1];
        const std::size_t pixels =
            tile_rows % (std::size_t{1} << k) * (kTileSide >> k) * level.columns;
        function(level.samples.data(), pixels * sampleBytes(type_));
        if (has_mask_) {
            function(level.valid.data(), pixels);
        }
    }
    if (!sum_bits_.empty()) {
        const std::size_t tiles = tile_rows * tile_columns_;
        function(sum_bits_.data(), tiles * sizeof(std::uint64_t));
        function(counts_.data(), tiles * sizeof(std::uint64_t));
    }
}

std::vector<std::uint8_t> OverviewBuilder::save(std::size_t tile_rows) const
{
    std::vector<std::uint8_t> saved;
    // Saving and restoring share one list of parts; here they are only read.
    const_cast<OverviewBuilder*>(this)->forEachPending( // NOLINT
        tile_rows, [&saved](const void* data, std::size_t bytes) {
            const auto* begin = static_cast<const std::uint8_t*>(data);
            saved.insert(saved.end(), begin, begin + bytes);
        });
    return saved;
}

bool OverviewBuilder::restore(std::size_t tile_rows, const std::vector<std::uint8_t>& saved)
{
    std::size_t wanted = 0;
    forEachPending(tile_rows, [&wanted](const void*, std::size_t bytes) { wanted += bytes; });
    if (wanted != saved.size()) {
        return false;
    }
    std::size_t at = 0;
    forEachPending(tile_rows, [&](void* data, std::size_t bytes) {
        if (bytes > 0) {
            std::memcpy(data, saved.data() + at, bytes);
        }
        at += bytes;
    });
    return true;
}

} // namespace marsview
