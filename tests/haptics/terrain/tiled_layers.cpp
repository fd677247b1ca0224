#include "tests/haptics/terrain/tiled_layers.h"

#include "core/body/pinned_samples.h"
#include "core/levels/waiting_terrain.h"
#include "tests/core/contact/contact_terrain.h"

#include <gtest/gtest.h>

#include <cstring>
#include <utility>

namespace marsview::test {

TiledLayers::TiledLayers(const NestedMaps& nested, std::size_t index, double exaggeration)
    : in_tiles(index)
    , map(tiledMap(heightsOf(nested.maps[index])->heightfield()))
    , meshes(meshesOf(nested, exaggeration))
{
    for (const NestedMap& one : nested.maps) {
        georeferences.push_back(std::make_shared<const Georeference>(georeferenceOf(one.map)));
    }
    JobMonitor monitor;
    const auto grid =
        BodyGrid::make(*georeferences[in_tiles], monitor, meshes[in_tiles]->ellipsoid()).value();
    tiled = TiledBodyMesh::build(grid, map.heights, exaggeration, monitor).value();
    meshes[in_tiles] = nullptr;
    const auto waiting =
        std::make_shared<const WaitingTerrain>(TiledRaster(cache, map.source), map.heights, 4);
    const auto built = LayeredMesh::build(meshesOver(waiting), monitor);
    EXPECT_TRUE(built) << (built ? "" : built.error().message);
    joined = *built;
}

std::vector<std::shared_ptr<const BodyMesh>>
TiledLayers::meshesOver(std::shared_ptr<const TiledTerrain> terrain) const
{
    auto all = meshes;
    all[in_tiles] = tiled->over(std::move(terrain));
    return all;
}

std::shared_ptr<const LayeredMesh>
TiledLayers::over(std::shared_ptr<const TiledTerrain> terrain) const
{
    return joined->over(tiled->over(std::move(terrain), joined->tiledMap()->pins()));
}

std::shared_ptr<const LayeredMesh>
TiledLayers::inMemory(std::shared_ptr<const FilledHeightfield> heights) const
{
    JobMonitor monitor;
    auto all = meshes;
    all[in_tiles] = BodyMesh::build(std::move(heights), *georeferences[in_tiles],
                                    tiled->exaggeration(), monitor, ellipsoid())
                        .value();
    return LayeredMesh::build(all, monitor).value();
}

std::shared_ptr<const FilledHeightfield> TiledLayers::felt(const TiledTerrain& terrain) const
{
    const std::size_t columns = map.layout().columns;
    const std::size_t rows = map.layout().rows;
    const std::size_t first_row = tiled->grid()->positions().firstRow();
    SampleGrid grid = SampleGrid::create(SampleType::Float64, columns, rows).value();
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const bool is_pinned = row >= first_row && pins().find(column, row - first_row);
            const double height_m =
                is_pinned ? map.filled->sample(column, row) : terrain.sample(column, row);
            std::memcpy(grid.rowData(row) + sizeof height_m * column, &height_m, sizeof height_m);
        }
    }
    const SampleStatistics statistics = grid.applyRule({}, 0, rows);
    grid.clearVoids();
    return filledTerrain(
        Heightfield(std::make_shared<const SampleGrid>(std::move(grid)), statistics, {}));
}

} // namespace marsview::test
