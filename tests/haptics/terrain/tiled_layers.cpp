#include "tests/haptics/terrain/tiled_layers.h"

#include "core/body/tiled_rim.h"
#include "core/levels/waiting_terrain.h"
#include "tests/core/contact/contact_terrain.h"

#include <gtest/gtest.h>

#include <cstring>
#include <utility>

namespace marsview::test {

TiledLayers::TiledLayers(const BodyMap& fine, const NestedMap& coarse, double exaggeration)
    : georeferences{std::make_shared<const Georeference>(georeferenceOf(fine)),
                    std::make_shared<const Georeference>(georeferenceOf(coarse.map))}
    , map(tiledMap(fractalMap(fine)->heightfield()))
    , lower(meshesOf({"Lower", {coarse}}, exaggeration).front())
{
    JobMonitor monitor;
    const auto grid = BodyGrid::make(*georeferences.front(), monitor, lower->ellipsoid()).value();
    tiled = TiledBodyMesh::build(grid, map.heights, exaggeration, monitor).value();
    const auto waiting =
        std::make_shared<const WaitingTerrain>(TiledRaster(cache, map.source), map.heights, 4);
    const auto rim = TiledRim::read(grid->positions(), *waiting, monitor);
    EXPECT_TRUE(rim) << (rim ? "" : rim.error().message);
    const auto built = LayeredMesh::build({tiled->over(waiting, *rim), lower}, monitor);
    EXPECT_TRUE(built) << (built ? "" : built.error().message);
    joined = *built;
}

std::shared_ptr<const LayeredMesh>
TiledLayers::over(std::shared_ptr<const TiledTerrain> terrain) const
{
    return joined->over(tiled->over(std::move(terrain), joined->map(0)->rim()));
}

std::shared_ptr<const LayeredMesh>
TiledLayers::inMemory(std::shared_ptr<const FilledHeightfield> heights) const
{
    JobMonitor monitor;
    const auto upper = BodyMesh::build(std::move(heights), *georeferences.front(),
                                       lower->exaggeration(), monitor, lower->ellipsoid());
    return LayeredMesh::build({*upper, lower}, monitor).value();
}

std::shared_ptr<const FilledHeightfield> TiledLayers::felt(const TiledTerrain& terrain) const
{
    const std::size_t columns = map.layout().columns;
    const std::size_t rows = map.layout().rows;
    const bool wraps = tiled->grid()->positions().wraps();
    SampleGrid grid = SampleGrid::create(SampleType::Float64, columns, rows).value();
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const bool is_at_rim =
                row < 2 || row + 2 >= rows || (!wraps && (column < 2 || column + 2 >= columns));
            const double height_m =
                is_at_rim ? map.filled->sample(column, row) : terrain.sample(column, row);
            std::memcpy(grid.rowData(row) + sizeof height_m * column, &height_m, sizeof height_m);
        }
    }
    const SampleStatistics statistics = grid.applyRule({}, 0, rows);
    grid.clearVoids();
    return filledTerrain(
        Heightfield(std::make_shared<const SampleGrid>(std::move(grid)), statistics, {}));
}

} // namespace marsview::test
