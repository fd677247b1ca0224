#include "core/tiles/mean_samples_source.h"

#include "core/base/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <list>
#include <type_traits>
#include <utility>
#include <vector>

namespace marsview {
namespace {

// Tiles of means that a reader caches: a tile of samples needs up to four, and the next one two of
// these again. At levels coarser than all means it needs up to sixteen.
constexpr std::size_t kRememberedMax = 20;

// Where a sample lies between the centers of blocks.
struct Between {
    std::size_t before = 0;
    std::size_t after = 0;
    double share = 0.0; // of `after`
};

Between between(std::size_t sample, std::size_t level, std::size_t block_count)
{
    const double blocks = static_cast<double>(std::size_t{1} << level);
    const double place = std::clamp((static_cast<double>(sample) + 0.5) / blocks - 0.5, 0.0,
                                    static_cast<double>(block_count - 1));
    const auto before = static_cast<std::size_t>(place);
    return {before, std::min(before + 1, block_count - 1), place - static_cast<double>(before)};
}

template <typename T>
T sampleFrom(double value)
{
    if constexpr (std::is_floating_point_v<T>) {
        return static_cast<T>(value);
    } else {
        // Means of values of the type: only rounding, and 64-bit numbers beyond the precision of
        // doubles, can exceed its range.
        const double rounded = std::round(value);
        if (rounded >= static_cast<double>(std::numeric_limits<T>::max())) {
            return std::numeric_limits<T>::max();
        }
        if (rounded <= static_cast<double>(std::numeric_limits<T>::lowest())) {
            return std::numeric_limits<T>::lowest();
        }
        return static_cast<T>(rounded);
    }
}

class MeanSamplesReader final : public TileReader {
public:
    MeanSamplesReader(std::unique_ptr<TileReader> reader,
                      const TileLayout& layout,
                      std::size_t exact_levels)
        : reader_(std::move(reader))
        , layout_(layout)
        , exact_levels_(exact_levels)
    {}

    Result<Tile> read(const TileId& id) override
    {
        MARSVIEW_CHECK(layout_.contains(id));
        const bool is_exact =
            id.kind == TileKind::Means || id.level < exact_levels_ || layout_.mean_levels == 0;
        return is_exact ? reader_->read(id) : interpolated(id);
    }

private:
    Result<Tile> interpolated(const TileId& id)
    {
        const std::size_t level = std::min<std::size_t>(id.level, layout_.mean_levels);
        const std::size_t width = layout_.tileWidth(id);
        const std::size_t height = layout_.tileHeight(id);
        const auto along = [&](std::size_t tile, std::size_t count, std::size_t samples) {
            const std::size_t blocks = TileLayout::samplesAlong(TileKind::Means, level, samples);
            std::vector<Between> places;
            for (std::size_t i = 0; i < count; ++i) {
                const std::size_t sample =
                    std::min((tile * kTileSide + i) << id.level, samples - 1);
                places.push_back(between(sample, level, blocks));
            }
            return places;
        };
        const std::vector<Between> columns = along(id.column, width, layout_.columns);
        const std::vector<Between> rows = along(id.row, height, layout_.rows);
        Result<Window> means = readMeans(level, columns.front().before, columns.back().after,
                                         rows.front().before, rows.back().after);
        if (!means) {
            return std::move(means).error();
        }
        Result<SampleGrid> grid = SampleGrid::create(layout_.type, width, height);
        if (!grid) {
            return std::move(grid).error();
        }
        dispatchSampleType(layout_.type, [&](auto zero) {
            using T = decltype(zero);
            for (std::size_t j = 0; j < height; ++j) {
                std::byte* to = grid->rowData(j);
                for (std::size_t i = 0; i < width; ++i) {
                    const double value = means->at(columns[i], rows[j]);
                    const T sample = std::isnan(value) ? T{} : sampleFrom<T>(value);
                    std::memcpy(to + i * sizeof(T), &sample, sizeof(T));
                    if (std::isnan(value)) {
                        grid->markVoid(i, j);
                    }
                }
            }
        });
        return Tile{.id = id, .samples = std::move(grid).value(), .filled_m = {}};
    }

    // Means of some blocks, NaN where void.
    struct Window {
        std::size_t column = 0;
        std::size_t row = 0;
        std::size_t columns = 0;
        std::vector<double> means;

        double& mean(std::size_t c, std::size_t r)
        {
            return means[(r - row) * columns + (c - column)];
        }
        // The mean of those of the four blocks around that are not void; NaN where all are.
        double at(const Between& c, const Between& r)
        {
            double sum = 0.0;
            double weight = 0.0;
            const auto add = [&](double value, double share) {
                if (!std::isnan(value) && share > 0.0) {
                    sum += value * share;
                    weight += share;
                }
            };
            add(mean(c.before, r.before), (1.0 - c.share) * (1.0 - r.share));
            add(mean(c.after, r.before), c.share * (1.0 - r.share));
            add(mean(c.before, r.after), (1.0 - c.share) * r.share);
            add(mean(c.after, r.after), c.share * r.share);
            return weight > 0.0 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
        }
    };

    Result<Window> readMeans(std::size_t level,
                             std::size_t first_column,
                             std::size_t last_column,
                             std::size_t first_row,
                             std::size_t last_row)
    {
        Window window{first_column, first_row, last_column - first_column + 1, {}};
        window.means.resize(window.columns * (last_row - first_row + 1));
        for (std::size_t row = first_row / kTileSide; row <= last_row / kTileSide; ++row) {
            for (std::size_t column = first_column / kTileSide; column <= last_column / kTileSide;
                 ++column) {
                const Result<const Tile*> tile = meansTile(
                    {TileKind::Means, static_cast<std::uint8_t>(level),
                     static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)});
                if (!tile) {
                    return tile.error();
                }
                const SampleGrid& grid = (*tile)->samples;
                const std::size_t left = column * kTileSide;
                const std::size_t upper = row * kTileSide;
                for (std::size_t r = std::max(upper, first_row);
                     r <= std::min(upper + grid.rows() - 1, last_row); ++r) {
                    for (std::size_t c = std::max(left, first_column);
                         c <= std::min(left + grid.columns() - 1, last_column); ++c) {
                        window.mean(c, r) = grid.isVoid(c - left, r - upper)
                                                ? std::numeric_limits<double>::quiet_NaN()
                                                : grid.raw(c - left, r - upper);
                    }
                }
            }
        }
        return window;
    }

    Result<const Tile*> meansTile(const TileId& id)
    {
        const auto known = std::find_if(remembered_.begin(), remembered_.end(),
                                        [&id](const Tile& tile) { return tile.id == id; });
        if (known != remembered_.end()) {
            remembered_.splice(remembered_.begin(), remembered_, known);
            return &remembered_.front();
        }
        Result<Tile> tile = reader_->read(id);
        if (!tile) {
            return std::move(tile).error();
        }
        if (remembered_.size() >= kRememberedMax) {
            remembered_.pop_back();
        }
        remembered_.push_front(std::move(tile).value());
        return &remembered_.front();
    }

    std::unique_ptr<TileReader> reader_;
    TileLayout layout_;
    std::size_t exact_levels_;
    std::list<Tile> remembered_; // of Means, most recently used first
};

class MeanSamplesSource final : public TileSource {
public:
    MeanSamplesSource(std::shared_ptr<const TileSource> source, std::size_t exact_levels)
        : source_(std::move(source))
        , exact_levels_(exact_levels)
    {}

    const TileLayout& layout() const noexcept override { return source_->layout(); }
    const std::string& name() const noexcept override { return source_->name(); }
    Result<std::unique_ptr<TileReader>> open() const override
    {
        Result<std::unique_ptr<TileReader>> reader = source_->open();
        if (!reader) {
            return reader;
        }
        return std::unique_ptr<TileReader>(std::make_unique<MeanSamplesReader>(
            std::move(reader).value(), source_->layout(), exact_levels_));
    }

private:
    std::shared_ptr<const TileSource> source_;
    std::size_t exact_levels_;
};

} // namespace

std::shared_ptr<const TileSource> samplesFromMeans(std::shared_ptr<const TileSource> source,
                                                   std::size_t exact_levels)
{
    MARSVIEW_CHECK(exact_levels >= 1);
    return std::make_shared<const MeanSamplesSource>(std::move(source), exact_levels);
}

} // namespace marsview
