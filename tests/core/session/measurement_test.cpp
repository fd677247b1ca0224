#include "core/session/measurement.h"
#include "core/session/open_map.h"
#include "tests/support/make_raster.h"
#include "tests/support/map_maker.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

namespace marsview::test {
namespace {

Measurement between(MeasurementKind kind, const std::vector<std::pair<double, double>>& lonlat)
{
    Measurement measurement{.kind = kind};
    for (const auto& [longitude, latitude] : lonlat) {
        measurement.vertices.emplace_back(
            GeographicPoint{Angle::degrees(longitude), Angle::degrees(latitude)});
    }
    return measurement;
}

std::shared_ptr<const MeasurementResult>
resultOf(const Measurement& measurement, const Map& map, MeasureDetail detail = MeasureDetail::Full)
{
    JobMonitor monitor;
    return measured(measurement, map, detail, monitor);
}

template <typename T>
const T& valueIn(const std::shared_ptr<const MeasurementResult>& result)
{
    EXPECT_TRUE(result->values) << (result->values ? "" : result->values.error().message);
    return std::get<T>(*result->values);
}

} // namespace

TEST(Measurement, FollowsTheOverridesOfItsLayer)
{
    const auto map = loadedMap(bundledMars());
    Measurement measurement = between(MeasurementKind::Distance, {{226.0, 18.0}, {230.0, 20.0}});
    EXPECT_FALSE(isCurrent(measurement, *map));
    measurement.result = resultOf(measurement, *map);
    EXPECT_TRUE(isCurrent(measurement, *map));
    const Distance before = valueIn<Distance>(measurement.result);

    RasterOverrides larger;
    larger.ellipsoid = Ellipsoid{2.0 * 3396000.0, 2.0 * 3396000.0};
    larger.vertical_unit = "ft";
    const auto changed = overridden(*map, larger);
    ASSERT_TRUE(changed) << changed.error().message;
    EXPECT_FALSE(isCurrent(measurement, **changed));
    measurement.result = resultOf(measurement, **changed);
    EXPECT_TRUE(isCurrent(measurement, **changed));
    const Distance after = valueIn<Distance>(measurement.result);
    EXPECT_NEAR(after.geodesic_m, 2.0 * before.geodesic_m, 1e-6);
    EXPECT_NEAR(after.rise_m, 0.3048 * before.rise_m, 1e-6);
}

TEST(Measurement, KnowsTheElevationsOfItsVertices)
{
    const auto map = loadedMap(bundledMars());
    const auto result =
        resultOf(between(MeasurementKind::Distance, {{226.0, 18.0}, {230.0, 20.0}}), *map);
    ASSERT_EQ(result->elevations_m.size(), 2U);
    EXPECT_NEAR(result->elevations_m[1] - result->elevations_m[0], valueIn<Distance>(result).rise_m,
                1e-9);
    const auto slope = resultOf(between(MeasurementKind::Slope, {{230.0, 20.0}}), *map);
    EXPECT_EQ(valueIn<std::vector<TerrainSlope>>(slope).front().elevation_m,
              result->elevations_m[1]);
}

TEST(Measurement, HasAResultOfEveryKind)
{
    const auto map = loadedMap(bundledMars());
    const std::vector<std::pair<double, double>> vertices{
        {226.0, 18.0}, {230.0, 20.0}, {228.0, 15.0}};
    EXPECT_EQ(
        valueIn<Distance>(resultOf(between(MeasurementKind::Distance, vertices), *map)).legs.size(),
        2U);
    EXPECT_GT(
        valueIn<TerrainArea>(resultOf(between(MeasurementKind::Area, vertices), *map)).surface_m2,
        0.0);
    EXPECT_GT(
        valueIn<Profile>(resultOf(between(MeasurementKind::Profile, vertices), *map)).points.size(),
        20U);
    EXPECT_EQ(
        valueIn<Attitude>(resultOf(between(MeasurementKind::Attitude, vertices), *map)).points, 3U);
    EXPECT_GT(
        valueIn<Crater>(resultOf(between(MeasurementKind::Crater, vertices), *map)).diameter_m,
        0.0);
    EXPECT_EQ(valueIn<std::vector<TerrainSlope>>(
                  resultOf(between(MeasurementKind::Slope, vertices), *map))
                  .size(),
              3U);
}

TEST(Measurement, AnAreaThatIsTooLargeForAPlaneLacksOnlyVolumes)
{
    const auto map = loadedMap(bundledMars());
    Measurement large = between(MeasurementKind::Area,
                                {{200.0, -40.0}, {300.0, -40.0}, {300.0, 40.0}, {200.0, 40.0}});
    large.area.base = VolumeBase::BorderPlane;
    const auto area = valueIn<TerrainArea>(resultOf(large, *map));
    EXPECT_GT(area.surface_m2, 1e13);
    EXPECT_FALSE(area.volume_above_m3);
    Measurement small =
        between(MeasurementKind::Area, {{226.0, 18.0}, {230.0, 20.0}, {228.0, 15.0}});
    small.area.base = VolumeBase::BorderPlane;
    EXPECT_TRUE(valueIn<TerrainArea>(resultOf(small, *map)).volume_above_m3);
}

TEST(Measurement, KeepsTheReasonOfAFailure)
{
    const auto map = loadedMap(bundledMars());
    const auto result = resultOf(between(MeasurementKind::Area, {{226.0, 18.0}}), *map);
    ASSERT_FALSE(result->values);
    EXPECT_EQ(result->values.error().message, "an area needs at least 3 positions, but there is 1");
    Measurement on_plane{.kind = MeasurementKind::Distance};
    on_plane.vertices = {MapPoint{1.0, 2.0}, MapPoint{3.0, 4.0}};
    const auto other = resultOf(on_plane, *map);
    ASSERT_FALSE(other->values);
    EXPECT_EQ(other->values.error().message,
              "was measured while the map had no CRS; measure it again");
    JobMonitor canceled;
    canceled.cancel();
    EXPECT_EQ(measured(between(MeasurementKind::Profile, {{1.0, 2.0}, {90.0, 4.0}}), *map,
                       MeasureDetail::Full, canceled),
              nullptr);
}

TEST(Measurement, OnAMapWithoutACrsUsesItsCoordinates)
{
    MapMaker maker;
    const auto map = maker.make({.transform = {100.0, 2.0, 0.0, 50.0, 0.0, -2.0}, .srs = ""},
                                [](std::size_t, std::size_t) { return 1.0; });
    Measurement measurement{.kind = MeasurementKind::Distance};
    measurement.vertices = {*vertexAt(map->georeference(), {1.0, 1.0}),
                            *vertexAt(map->georeference(), {4.0, 5.0})};
    EXPECT_NEAR(valueIn<Distance>(resultOf(measurement, *map)).geodesic_m, 10.0, 1e-12);
    const auto mars = loadedMap(bundledMars());
    EXPECT_TRUE(
        std::holds_alternative<GeographicPoint>(*vertexAt(mars->georeference(), {1.0, 1.0})));
}

// On a map in tiles: the quick profile reads the tiles of a coarse level only, the full one those
// under the line.
TEST(Measurement, QuickProfileOfALargeMapReadsFewTiles)
{
    constexpr std::size_t kColumns = 9000;
    constexpr std::size_t kRows = 4500;
    std::vector<std::int16_t> samples(kColumns * kRows);
    for (std::size_t r = 0; r < kRows; ++r) {
        for (std::size_t c = 0; c < kColumns; ++c) {
            samples[r * kColumns + c] =
                static_cast<std::int16_t>(2000.0 * std::sin(0.002 * static_cast<double>(c)) *
                                          std::cos(0.003 * static_cast<double>(r)));
        }
    }
    RasterRecipe recipe = recipeFor(kColumns, samples);
    recipe.transform = {-180.0, 0.04, 0.0, 90.0, 0.0, -0.04};
    recipe.srs = "IAU_2015:49900";
    const TempFolder folder;
    const std::string path =
        writeRaster(folder, "large.tif", "GTiff", recipe, {"-co", "TILED=YES"});
    const TempFolder prepared;
    MapResources resources;
    resources.tiles =
        std::make_shared<TileCache>(TileCacheOptions{.bytes_max = std::size_t{256} << 20});
    resources.held_bytes_max = 0;
    resources.folder = prepared.path();
    JobMonitor monitor;
    const auto map = openMap({.path = path}, resources, monitor);
    ASSERT_TRUE(map) << map.error().message;
    ASSERT_TRUE((*map)->heightfield().isTiled());

    Measurement profile =
        between(MeasurementKind::Profile, {{-170.0, 40.0}, {0.0, -10.0}, {160.0, 30.0}});
    const auto loaded = [&] { return resources.tiles->statistics().loaded; };
    const std::uint64_t before = loaded();
    profile.result = resultOf(profile, **map, MeasureDetail::Quick);
    const std::uint64_t quick_tiles = loaded() - before;
    const Profile quick = valueIn<Profile>(profile.result);
    EXPECT_TRUE(profile.result->is_approximate);
    EXPECT_TRUE(quick.is_approximate);
    EXPECT_FALSE(isCurrent(profile, **map));
    profile.result = resultOf(profile, **map);
    const std::uint64_t full_tiles = loaded() - before - quick_tiles;
    const Profile full = valueIn<Profile>(profile.result);
    EXPECT_FALSE(full.is_approximate);
    EXPECT_TRUE(isCurrent(profile, **map));
    std::printf("quick: %llu tiles, %zu points; full: %llu tiles, %zu points of %zu tiles\n",
                static_cast<unsigned long long>(quick_tiles), quick.points.size(),
                static_cast<unsigned long long>(full_tiles), full.points.size(),
                (kColumns / kTileSide + 1) * (kRows / kTileSide + 1));
    EXPECT_LT(2 * quick_tiles, full_tiles);
    EXPECT_LT(quick.points.size(), full.points.size());
    // The same line on the same terrain, within the coarser cells.
    EXPECT_EQ(quick.points.back().distance_m, full.points.back().distance_m);
    std::size_t k = 0;
    for (const ProfilePoint& point : quick.points) {
        while (k + 1 < full.points.size() && full.points[k + 1].distance_m <= point.distance_m) {
            ++k;
        }
        EXPECT_NEAR(point.elevation_m, full.points[k].elevation_m, 60.0);
    }
}

} // namespace marsview::test
