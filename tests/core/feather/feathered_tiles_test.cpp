// Maps in tiles with blended edges, against the same maps in memory.
#include "core/body/layered_mesh.h"
#include "core/body/tiled_body_mesh.h"
#include "core/feather/feathered_map.h"
#include "core/levels/waiting_terrain.h"
#include "tests/core/contact/nested_maps.h"
#include "tests/haptics/terrain/tiled_map.h"
#include "tests/support/map_maker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace marsview {
namespace {

constexpr std::size_t kFeather = 25;
constexpr std::size_t kMeanLevels = 5;

class FeatheredTiles : public testing::TestWithParam<bool> {
protected:
    bool hasVoids() const { return GetParam(); }

    double height(std::size_t column, std::size_t row) const
    {
        if (hasVoids() && column > 250 && column < 262 && row > 100 && row < 140) {
            return std::numeric_limits<double>::quiet_NaN();
        }
        return 900.0 +
               60.0 * std::sin(0.11 * static_cast<double>(column)) *
                   std::cos(0.07 * static_cast<double>(row)) +
               static_cast<double>((column * 37 + row * 91) % 17);
    }

    BodyTerrain onBody(const std::shared_ptr<const Map>& map) const
    {
        JobMonitor monitor;
        return {map, BodyGrid::make(map->georeference(), monitor,
                                    *lower_->georeference().crs()->ellipsoid())
                         .value()};
    }

    // The same map in tiles.
    std::shared_ptr<const Map> inTiles(const Map& map)
    {
        const Heightfield& heightfield = map.heightfield();
        const test::TiledMap tiled = test::tiledMap(heightfield, {.mean_levels = kMeanLevels});
        const HeightRange range = *heightfield.range();
        auto levels = std::make_shared<const MapLevels>(
            MapLevels{.layout = tiled.layout(),
                      .statistics = {.raw_minimum = range.minimum_m,
                                     .raw_maximum = range.maximum_m,
                                     .void_count = hasVoids() ? 429U : 0U,
                                     .sample_count = heightfield.columns() * heightfield.rows()},
                      .analysis = map.analysis(),
                      .filled_maxima_m = tiled.heights->filledMaxima(),
                      .checksums = nullptr});
        const auto tiles = TiledSamples::open(TiledRaster(cache_, tiled.source)).value();
        const SampleStatistics statistics = levels->statistics;
        return tiledMap({.spec = map.spec(),
                         .file_info = map.fileInfo(),
                         .info = map.info(),
                         .statistics = statistics,
                         .heightfield = Heightfield(tiles, statistics, heightfield.scale())},
                        levels)
            .value();
    }

    std::shared_ptr<const Map> blended(const std::shared_ptr<const Map>& map) const
    {
        JobMonitor monitor;
        return featheredMap(onBody(map), std::vector{onBody(lower_)}, kFeather, monitor).value();
    }

    TileCache cache_{{.bytes_max = std::size_t{64} << 20, .loader_threads = 1}};
    test::MapMaker maker_;
    std::shared_ptr<const Map> lower_ =
        maker_.make({60, 60, {225.4, 0.02, 0, 18.6, 0, -0.02}, "+proj=longlat +R=3396190"},
                    [](std::size_t column, std::size_t row) {
                        return 3.0 * static_cast<double>(column) - 2.0 * static_cast<double>(row);
                    });
    std::shared_ptr<const Map> upper_ =
        maker_.make({600,
                     530,
                     {-15000, 50, 0, 13000, 0, -50},
                     "+proj=tmerc +lat_0=18 +lon_0=226 +R=3396190 +units=m"},
                    [this](std::size_t column, std::size_t row) { return height(column, row); });
    std::shared_ptr<const Map> expected_ = blended(upper_); // in memory
    std::shared_ptr<const Map> tiled_ = blended(inTiles(*upper_));
};

TEST_P(FeatheredTiles, AllLevelsHaveTheSamplesOfTheMapInMemory)
{
    ASSERT_TRUE(tiled_->heightfield().isTiled());
    const TiledRaster& raster = tiled_->heightfield().tiles()->raster();
    const test::GridTileSource reference(expected_->heightfield(), {.mean_levels = kMeanLevels});
    const TileLayout& layout = raster.layout();
    EXPECT_EQ(layout.type, SampleType::Float64);
    std::vector<TileId> ids;
    const auto add = [&](TileKind kind, std::size_t level) {
        for (std::size_t row = 0; row < layout.tileRows(kind, level); ++row) {
            for (std::size_t column = 0; column < layout.tileColumns(kind, level); ++column) {
                ids.push_back({kind, static_cast<std::uint8_t>(level),
                               static_cast<std::uint32_t>(column),
                               static_cast<std::uint32_t>(row)});
            }
        }
    };
    for (std::size_t level = 0; level <= layout.topLevel(); ++level) {
        add(TileKind::Samples, level);
    }
    for (std::size_t level = 1; level <= kMeanLevels && !hasVoids(); ++level) {
        add(TileKind::Means, level);
    }
    for (const TileId& id : ids) {
        const auto tile = raster.get(id).value();
        const Tile other = reference.tile(id);
        ASSERT_EQ(tile->samples.columns(), other.samples.columns());
        for (std::size_t row = 0; row < other.samples.rows(); ++row) {
            for (std::size_t column = 0; column < other.samples.columns(); ++column) {
                ASSERT_EQ(tile->samples.isVoid(column, row), other.samples.isVoid(column, row));
                if (other.samples.isVoid(column, row)) {
                    continue;
                }
                // The band is kept as floats.
                ASSERT_NEAR(tile->samples.raw(column, row), other.samples.raw(column, row),
                            id.kind == TileKind::Samples ? 0.0 : 1e-3)
                    << int(id.level) << ' ' << column << ' ' << row;
            }
        }
    }
}

TEST_P(FeatheredTiles, BoundsAndErrorsAreTrue)
{
    const SurfaceAnalysis& now = *tiled_->analysis();
    const SurfaceAnalysis& exact = *expected_->analysis();
    for (std::size_t level = 0; level < exact.bounds.levelCount(); ++level) {
        for (std::size_t row = 0; row < exact.bounds.rows(level); ++row) {
            for (std::size_t column = 0; column < exact.bounds.columns(level); ++column) {
                const auto wanted = exact.bounds.bounds(level, column, row);
                const auto found = now.bounds.bounds(level, column, row);
                ASSERT_LE(found.minimum_m, wanted.minimum_m);
                ASSERT_GE(found.maximum_m, wanted.maximum_m);
            }
        }
    }
    const HeightRange range = *tiled_->heightfield().range();
    EXPECT_LE(range.minimum_m, expected_->heightfield().range()->minimum_m);
    EXPECT_GE(range.maximum_m, expected_->heightfield().range()->maximum_m);
    std::size_t same = 0;
    for (std::size_t level = 1; level < exact.errors.levelCount(); ++level) {
        for (std::size_t row = 0; row < exact.errors.rows(level); ++row) {
            for (std::size_t column = 0; column < exact.errors.columns(level); ++column) {
                const DetailNode node{.level = level, .column = column, .row = row};
                const float wanted_m = exact.errors.nodeError(node);
                ASSERT_GE(now.errors.nodeError(node), wanted_m * (1.0F - kShortRounding) - 1e-3F)
                    << level << ' ' << column << ' ' << row;
                same += now.errors.nodeError(node) == upper_->analysis()->errors.nodeError(node)
                            ? 1U
                            : 0U;
            }
        }
    }
    EXPECT_GT(same, 20U) << "away from the edges nothing changes";
}

// Cut out of the map below, each with its walls: the same triangles.
TEST_P(FeatheredTiles, AreJoinedToTheSurfaceOfTheMapInMemory)
{
    if (hasVoids()) {
        return; // maps in tiles that lie above others have none
    }
    JobMonitor monitor;
    const Ellipsoid ellipsoid = *lower_->georeference().crs()->ellipsoid();
    const auto mesh = [&](const Map& map) {
        return BodyMesh::build(map.filled(), map.georeference(), 1.0, monitor, ellipsoid).value();
    };
    const auto heights =
        std::make_shared<const TileHeights>(tiled_->levels(), tiled_->heightfield().scale());
    const auto terrain =
        std::make_shared<const WaitingTerrain>(tiled_->heightfield().tiles()->raster(), heights);
    const auto over =
        TiledBodyMesh::build(onBody(tiled_).grid(), heights, 1.0, monitor).value()->over(terrain);
    const auto lower = mesh(*lower_);
    const auto found = LayeredMesh::build({over, lower}, monitor).value();
    const auto wanted = LayeredMesh::build({mesh(*expected_), lower}, monitor).value();
    ASSERT_EQ(found->vertexCount(), wanted->vertexCount());
    for (BodyIndex i = 0; i < wanted->vertexCount(); ++i) {
        ASSERT_EQ(length(found->vertex(i) - wanted->vertex(i)), 0.0) << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Maps, FeatheredTiles, testing::Bool(), [](const auto& tested) {
    return tested.param ? "WithVoids" : "WithoutVoids";
});

} // namespace
} // namespace marsview
