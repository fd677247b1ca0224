#include "tests/haptics/terrain/tiled_map.h"

#include "tests/support/make_terrain.h"

#include <utility>

namespace marsview::test {

TileId samplesTile(std::size_t level, std::size_t column, std::size_t row)
{
    return {TileKind::Samples, static_cast<std::uint8_t>(level), static_cast<std::uint32_t>(column),
            static_cast<std::uint32_t>(row)};
}

std::shared_ptr<const Tile> TiledMap::tile(const TileId& id) const
{
    return std::make_shared<const Tile>(source->tile(id));
}

std::shared_ptr<const Tile> TiledMap::top() const
{
    return tile(samplesTile(layout().topLevel(), 0, 0));
}

Clipmap TiledMap::window(GridPoint center, const WindowSides& sides) const
{
    const std::vector<GridPoint> centers(layout().topLevel() + 1, center);
    return {heights, top(), centers, sides};
}

std::vector<TileId> tilesOf(const Clipmap& window)
{
    std::vector<TileId> tiles;
    for (std::size_t k = 0; k < window.levelCount(); ++k) {
        const Clipmap::Level& level = window.level(k);
        for (std::size_t r = 0; r < level.rows; ++r) {
            for (std::size_t c = 0; c < level.columns; ++c) {
                tiles.push_back(samplesTile(k, level.tileColumn(c), level.first_row + r));
            }
        }
    }
    return tiles;
}

TiledMap tiledMap(const Heightfield& heightfield, GridTileSource::Options options)
{
    JobMonitor monitor;
    TiledMap map;
    const auto analysis = analyzed(heightfield);
    map.filled = std::make_shared<const FilledHeightfield>(
        FilledHeightfield::build(heightfield, analysis, monitor).value());
    map.source = std::make_shared<GridTileSource>(heightfield, std::move(options));
    MapLevels levels{.layout = map.source->layout(),
                     .statistics = {},
                     .analysis = analysis,
                     .filled_maxima_m = {},
                     .checksums = nullptr};
    levels.statistics.sample_count = heightfield.columns() * heightfield.rows();
    const SampleGrid& samples = heightfield.samples();
    for (std::size_t row = 0; row < samples.rows(); ++row) {
        for (std::size_t column = 0; column < samples.columns(); ++column) {
            if (samples.isVoid(column, row)) {
                ++levels.statistics.void_count;
                continue;
            }
            const double raw = samples.raw(column, row);
            levels.statistics.raw_minimum = std::min(levels.statistics.raw_minimum, raw);
            levels.statistics.raw_maximum = std::max(levels.statistics.raw_maximum, raw);
        }
    }
    for (std::size_t k = 0; samples.hasVoids() && k < map.filled->levelCount(); ++k) {
        const std::size_t columns = analysis->bounds.columns(k);
        std::vector<float>& maxima = levels.filled_maxima_m.emplace_back();
        for (std::size_t i = 0; i < columns * analysis->bounds.rows(k); ++i) {
            maxima.push_back(static_cast<float>(map.filled->maximum(k, i % columns, i / columns)));
        }
    }
    map.heights = std::make_shared<const TileHeights>(
        std::make_shared<const MapLevels>(std::move(levels)), heightfield.scale());
    return map;
}

} // namespace marsview::test
