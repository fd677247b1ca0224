#include "tests/support/grid_tile_source.h"

#include "tests/support/make_terrain.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>

namespace marsview::test {
namespace {

std::size_t rasterIndex(std::size_t tile, std::size_t i, std::size_t level, std::size_t count)
{
    return std::min((tile * kTileSide + i) << level, count - 1);
}

template <typename T>
void put(SampleGrid& grid, std::size_t column, std::size_t row, T value)
{
    std::memcpy(grid.rowData(row) + column * sizeof(T), &value, sizeof(T));
}

} // namespace

class GridTileSource::Reader final : public TileReader {
public:
    explicit Reader(const GridTileSource& source)
        : source_(source)
    {}

    Result<Tile> read(const TileId& id) override
    {
        MARSVIEW_CHECK(source_.layout_.contains(id));
        ++source_.read_count_;
        if (source_.options_.before_read) {
            if (std::optional<Error> error = source_.options_.before_read(id)) {
                return std::move(*error);
            }
        }
        return source_.tile(id);
    }

private:
    const GridTileSource& source_;
};

GridTileSource::GridTileSource(const Heightfield& heightfield)
    : GridTileSource(heightfield, Options{})
{}

GridTileSource::GridTileSource(const Heightfield& heightfield, Options options)
    : heightfield_(heightfield)
    , options_(std::move(options))
    , layout_{.columns = heightfield.columns(),
              .rows = heightfield.rows(),
              .type = heightfield.samples().type(),
              .has_voids = heightfield.samples().hasVoids(),
              .mean_levels = options_.mean_levels,
              .is_remote = options_.is_remote}
{
    if (layout_.has_voids) {
        JobMonitor monitor;
        filled_ = FilledHeightfield::build(heightfield, analyzed(heightfield), monitor).value();
    }
}

Result<std::unique_ptr<TileReader>> GridTileSource::open() const
{
    ++open_count_;
    if (options_.before_open) {
        if (std::optional<Error> error = options_.before_open()) {
            return std::move(*error);
        }
    }
    return std::unique_ptr<TileReader>(std::make_unique<Reader>(*this));
}

Tile GridTileSource::tile(const TileId& id) const
{
    return id.kind == TileKind::Samples ? samplesTile(id) : meansTile(id);
}

Tile GridTileSource::samplesTile(const TileId& id) const
{
    const std::size_t width = layout_.tileWidth(id);
    const std::size_t height = layout_.tileHeight(id);
    SampleGrid samples = SampleGrid::create(layout_.type, width, height).value();
    std::vector<float> filled_m;
    for (std::size_t row = 0; row < height; ++row) {
        const std::size_t from_row = rasterIndex(id.row, row, id.level, layout_.rows);
        heightfield_.samples().visit([&](auto all) {
            for (std::size_t column = 0; column < width; ++column) {
                put(samples, column, row,
                    all(rasterIndex(id.column, column, id.level, layout_.columns), from_row));
            }
        });
        for (std::size_t column = 0; layout_.has_voids && column < width; ++column) {
            const std::size_t from_column =
                rasterIndex(id.column, column, id.level, layout_.columns);
            if (filled_->isVoid(from_column, from_row)) {
                samples.markVoid(column, row);
                filled_m.resize(width * height);
                filled_m[row * width + column] =
                    static_cast<float>(filled_->sample(from_column, from_row));
            }
        }
    }
    return {.id = id, .samples = std::move(samples), .filled_m = std::move(filled_m)};
}

Tile GridTileSource::meansTile(const TileId& id) const
{
    const std::size_t width = layout_.tileWidth(id);
    const std::size_t height = layout_.tileHeight(id);
    const std::size_t side = std::size_t{1} << id.level;
    SampleGrid samples = SampleGrid::create(layout_.type, width, height).value();
    const SampleGrid& all = heightfield_.samples();
    for (std::size_t row = 0; row < height; ++row) {
        for (std::size_t column = 0; column < width; ++column) {
            const std::size_t left = (id.column * kTileSide + column) * side;
            const std::size_t upper = (id.row * kTileSide + row) * side;
            double sum = 0.0;
            std::size_t count = 0;
            for (std::size_t r = upper; r < std::min(upper + side, layout_.rows); ++r) {
                for (std::size_t c = left; c < std::min(left + side, layout_.columns); ++c) {
                    if (!all.isVoid(c, r)) {
                        sum += all.raw(c, r);
                        ++count;
                    }
                }
            }
            if (count == 0) {
                samples.markVoid(column, row);
            }
            const double mean = count > 0 ? sum / static_cast<double>(count) : 0.0;
            dispatchSampleType(layout_.type, [&](auto zero) {
                using T = decltype(zero);
                put(samples, column, row,
                    static_cast<T>(std::is_integral_v<T> ? std::round(mean) : mean));
            });
        }
    }
    return {.id = id, .samples = std::move(samples), .filled_m = {}};
}

} // namespace marsview::test
