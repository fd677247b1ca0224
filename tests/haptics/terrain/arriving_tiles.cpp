#include "tests/haptics/terrain/arriving_tiles.h"

#include "tests/core/contact/contact_terrain.h"

#include <cstring>
#include <utility>

namespace marsview::test {

Arriving::Arriving(Random& random, const TiledMap& map, double rate_m_per_s)
    : random_(random)
    , map_(map)
    , center_{0.5 * static_cast<double>(map.layout().columns),
              0.5 * static_cast<double>(map.layout().rows)}
    , window_(std::make_unique<Clipmap>(map.window(center_)))
    , terrain_(std::make_shared<ResidentTerrain>(
          *window_, map.heights, ResidentTerrainOptions{.rate_m_per_s = rate_m_per_s}))
    , missing_(tilesOf(*window_))
{}

void Arriving::arrive(GridPoint hand)
{
    const std::size_t which = random_.below(missing_.size());
    const TileId id = missing_[which];
    missing_.erase(missing_.begin() + static_cast<std::ptrdiff_t>(which));
    auto next = std::make_unique<Clipmap>(map_.window(center_));
    for (const TileId& old : tilesOf(*window_)) {
        const Clipmap::Slot* slot = window_->slot(old);
        if (slot->tile) {
            next->put(slot->tile, slot->difference_m);
        }
    }
    next->put(map_.tile(id), 0.0);
    next->put(next->slot(id)->tile, next->differenceFromCoarser(id));
    terrain_->show(*next, hand);
    window_ = std::move(next);
}

std::shared_ptr<const FilledHeightfield> Arriving::felt() const
{
    const std::size_t columns = map_.layout().columns;
    const std::size_t rows = map_.layout().rows;
    SampleGrid grid = SampleGrid::create(SampleType::Float64, columns, rows).value();
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const double height = terrain_->sample(column, row);
            std::memcpy(grid.rowData(row) + sizeof height * column, &height, sizeof height);
        }
    }
    const SampleStatistics statistics = grid.applyRule({}, 0, rows);
    grid.clearVoids();
    return filledTerrain(
        Heightfield(std::make_shared<const SampleGrid>(std::move(grid)), statistics, {}));
}

} // namespace marsview::test
