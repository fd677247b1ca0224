#include "tests/haptics/terrain/tiled_layers.h"

#include "core/body/pinned_samples.h"
#include "core/levels/waiting_terrain.h"
#include "tests/core/contact/contact_terrain.h"

#include <gtest/gtest.h>

#include <cstring>
#include <utility>

namespace marsview::test {
namespace {

std::shared_ptr<const FilledHeightfield>
feltOf(const TiledLayerMap& one, const PinnedSamples& pins, const TiledTerrain& terrain)
{
    const std::size_t columns = one.map.layout().columns;
    const std::size_t rows = one.map.layout().rows;
    const std::size_t first_row = one.tiled->grid()->positions().firstRow();
    SampleGrid grid = SampleGrid::create(SampleType::Float64, columns, rows).value();
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const bool is_pinned = row >= first_row && pins.find(column, row - first_row);
            const double height_m =
                is_pinned ? one.map.filled->sample(column, row) : terrain.sample(column, row);
            std::memcpy(grid.rowData(row) + sizeof height_m * column, &height_m, sizeof height_m);
        }
    }
    const SampleStatistics statistics = grid.applyRule({}, 0, rows);
    grid.clearVoids();
    return filledTerrain(
        Heightfield(std::make_shared<const SampleGrid>(std::move(grid)), statistics, {}));
}

} // namespace

TiledLayers::TiledLayers(const NestedMaps& nested,
                         const std::vector<std::size_t>& in_tiles,
                         double exaggeration)
    : meshes(meshesOf(nested, exaggeration))
{
    for (const NestedMap& one : nested.maps) {
        georeferences.push_back(std::make_shared<const Georeference>(georeferenceOf(one.map)));
    }
    const Ellipsoid ellipsoid = meshes.front()->ellipsoid();
    JobMonitor monitor;
    for (const std::size_t i : in_tiles) {
        TiledMap map = tiledMap(heightsOf(nested.maps[i])->heightfield());
        const auto grid = BodyGrid::make(*georeferences[i], monitor, ellipsoid).value();
        auto tiled = TiledBodyMesh::build(grid, map.heights, exaggeration, monitor).value();
        tiles.push_back({.index = i, .map = std::move(map), .tiled = std::move(tiled)});
        meshes[i] = nullptr;
    }
    const auto built = LayeredMesh::build(meshesOver(waiting()), monitor);
    EXPECT_TRUE(built) << (built ? "" : built.error().message);
    joined = *built;
}

TiledLayers::Terrains TiledLayers::waiting() const
{
    Terrains terrains;
    for (const TiledLayerMap& one : tiles) {
        terrains.push_back(std::make_shared<const WaitingTerrain>(
            TiledRaster(cache, one.map.source), one.map.heights, 4));
    }
    return terrains;
}

std::vector<std::shared_ptr<const BodyMesh>> TiledLayers::meshesOver(const Terrains& terrains) const
{
    auto all = meshes;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        all[tiles[i].index] = tiles[i].tiled->over(terrains[i]);
    }
    return all;
}

std::shared_ptr<const LayeredMesh> TiledLayers::over(const Terrains& terrains) const
{
    std::vector<std::shared_ptr<const BodyMesh>> tiled;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const auto& map = joined->map(tiles[i].index);
        tiled.push_back(tiles[i].tiled->over(terrains[i], map->pins()));
    }
    return joined->over(tiled);
}

std::shared_ptr<const LayeredMesh> TiledLayers::inMemory(const Heights& heights) const
{
    JobMonitor monitor;
    auto all = meshes;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        all[tiles[i].index] = BodyMesh::build(heights[i], *georeferences[tiles[i].index],
                                              joined->exaggeration(), monitor, ellipsoid())
                                  .value();
    }
    return LayeredMesh::build(all, monitor).value();
}

TiledLayers::Heights TiledLayers::felt(const Terrains& terrains) const
{
    Heights heights;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        heights.push_back(feltOf(tiles[i], pins(i), *terrains[i]));
    }
    return heights;
}

TiledLayers::Heights TiledLayers::filled() const
{
    Heights heights;
    for (const TiledLayerMap& one : tiles) {
        heights.push_back(one.map.filled);
    }
    return heights;
}

} // namespace marsview::test
