#include "core/measure/grid_steps.h"
#include "core/measure/terrain_slope.h"
#include "tests/core/measure/measured_map.h"
#include "tests/support/make_raster.h"
#include "tests/support/map_maker.h"
#include "tests/support/random.h"
#include "tests/support/reference_ellipsoid.h"
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <vector>

namespace marsview::test {
namespace {

TerrainSlope slopeAt(MeasuredTerrain& terrain,
                     GroundPosition position,
                     std::optional<double> baseline_m = std::nullopt)
{
    JobMonitor monitor;
    const std::vector<GroundPosition> positions{position};
    const auto slopes = measureSlopes(terrain, positions, baseline_m, monitor);
    EXPECT_TRUE(slopes) << slopes.error().message;
    return slopes->front();
}

// What gdaldem writes, as floats.
std::vector<float> gdaldem(const TempFolder& folder,
                           const std::string& mode,
                           const std::string& path,
                           std::size_t count)
{
    const std::string out = folder.file(mode + ".raw");
    runTool({"gdaldem", mode, path, out, "-of", "ENVI", "-alg", "ZevenbergenThorne", "-q"});
    const std::string bytes = readFile(out);
    std::vector<float> values(count);
    EXPECT_EQ(bytes.size(), count * sizeof(float));
    std::memcpy(values.data(), bytes.data(), std::min(bytes.size(), count * sizeof(float)));
    return values;
}

} // namespace

// gdaldem takes lengths and north from the map, so the map must be true to scale and to north:
// Transverse Mercator at its central meridian. Zevenbergen and Thorne's slope is that of the four
// neighbors: a baseline of two samples.
TEST(TerrainSlope, IsThatOfGdaldemOnAMapThatIsTrueToScale)
{
    constexpr std::size_t kColumns = 40;
    constexpr std::size_t kRows = 50;
    Random random;
    std::vector<float> heights;
    for (std::size_t i = 0; i < kColumns * kRows; ++i) {
        heights.push_back(static_cast<float>(random.uniform(0.0, 0.5)));
    }
    RasterRecipe recipe = recipeFor(kColumns, heights);
    recipe.transform = {-40.0, 2.0, 0.0, 50.0, 0.0, -2.0};
    recipe.srs = "+proj=tmerc +lat_0=45 +lon_0=10 +ellps=WGS84 +units=m";
    const TempFolder folder;
    const std::string path = writeRaster(folder, "noise.tif", "GTiff", recipe);
    const auto map = loadedMap(path);
    MeasuredTerrain terrain = terrainOf(*map);
    const std::vector<float> slope = gdaldem(folder, "slope", path, heights.size());
    const std::vector<float> aspect = gdaldem(folder, "aspect", path, heights.size());
    int compared = 0;
    for (std::size_t r = 1; r + 1 < kRows; ++r) {
        for (std::size_t c = 1; c + 1 < kColumns; ++c) {
            const TerrainSlope found = slopeAt(
                terrain, *terrain.fromGrid({static_cast<double>(c), static_cast<double>(r)}), 4.0);
            ASSERT_NEAR(found.slope_deg, double{slope[r * kColumns + c]}, 2e-3) << c << " " << r;
            // Where the terrain is nearly level, its aspect is ill-defined.
            const double across = std::sin(found.slope_deg * std::numbers::pi / 180.0) *
                                  angleBetween(found.aspect_deg, double{aspect[r * kColumns + c]});
            ASSERT_LT(across, 2e-3) << c << " " << r;
            ++compared;
        }
    }
    EXPECT_EQ(compared, 48 * 38);
}

TEST(TerrainSlope, IsTrueInEveryDirectionWhereAMapIsNot)
{
    // At 60° north a degree of longitude is half a degree of latitude: terrain that rises by the
    // same amount per sample to the east and to the north rises twice as steeply to the east.
    MapMaker maker;
    const auto map =
        maker.make({.columns = 20,
                    .rows = 20,
                    .transform = {10.0, 0.01, 0.0, 60.1, 0.0, -0.01},
                    .srs = "EPSG:4326"},
                   [](std::size_t c, std::size_t r) {
                       return 100.0 * static_cast<double>(c) - 100.0 * static_cast<double>(r);
                   });
    MeasuredTerrain terrain = terrainOf(*map);
    const double latitude = 60.0;
    const auto east_m =
        static_cast<double>(parallelRadius(6378137.0L, 6356752.314245179L, latitude)) * 0.01 *
        std::numbers::pi / 180.0;
    const auto north_m =
        static_cast<double>(meridianRadius(6378137.0L, 6356752.314245179L, latitude)) * 0.01 *
        std::numbers::pi / 180.0;
    const double east = 100.0 / east_m;
    const double north = 100.0 / north_m;
    const TerrainSlope cell = slopeAt(terrain, {10.1, latitude});
    EXPECT_NEAR(cell.slope_deg, std::atan(std::hypot(east, north)) * 180.0 / std::numbers::pi,
                1e-6);
    EXPECT_NEAR(cell.aspect_deg, 180.0 + std::atan2(east, north) * 180.0 / std::numbers::pi, 1e-6);
    const TerrainSlope baseline = slopeAt(terrain, {10.1, latitude}, 2000.0);
    EXPECT_NEAR(baseline.slope_deg, cell.slope_deg, 0.01);
    EXPECT_NEAR(baseline.aspect_deg, cell.aspect_deg, 0.02);
}

TEST(TerrainSlope, OfLevelTerrainHasNoAspect)
{
    MapMaker maker;
    const auto map =
        maker.make({.srs = "EPSG:32610"}, [](std::size_t, std::size_t) { return 7.0; });
    MeasuredTerrain terrain = terrainOf(*map);
    const TerrainSlope level = slopeAt(terrain, *terrain.fromGrid({5.5, 5.25}));
    EXPECT_EQ(level.slope_deg, 0.0);
    EXPECT_TRUE(std::isnan(level.aspect_deg));
    EXPECT_EQ(level.elevation_m, 7.0);
    const TerrainSlope outside = slopeAt(terrain, *terrain.fromGrid({-5.0, 5.0}));
    EXPECT_TRUE(std::isnan(outside.slope_deg));
}

TEST(GridSteps, AreDerivativesOnTheGround)
{
    Random random;
    MapMaker maker;
    const auto flat = [](std::size_t, std::size_t) { return 0.0; };
    for (const MapMaker::Place& place :
         {MapMaker::Place{.transform = {-1e6, 1e5, 0, 8e5, 0, -1e5},
         .srs = "+proj=stere +lat_0=90 +a=3396190 +b=3376200"},
          MapMaker::Place{.transform = {-20.0, 1.0, 0.2, 50.0, 0.1, -1.0}, .srs = "IAU_2015:49900"},
          MapMaker::Place{.transform = {500000.0, 30.0, 0.0, 4000000.0, 0.0, -30.0},
          .srs = "EPSG:32610"}}) {
        SCOPED_TRACE(place.srs);
        const auto map = maker.make(place, flat);
        const MeasuredTerrain terrain = terrainOf(*map);
        for (int i = 0; i < 50; ++i) {
            const GridPoint grid{random.uniform(0.0, 19.0), random.uniform(0.0, 14.0)};
            const auto steps = gridSteps(terrain, grid);
            ASSERT_TRUE(steps);
            // A short way on the grid, by its geodesic.
            const GridPoint there{grid.column + 1e-3, grid.row + 2e-3};
            const GroundPosition a = *terrain.fromGrid(grid);
            const GroundPosition b = *terrain.fromGrid(there);
            const GroundLine line = terrain.ground().line(a, b);
            const double east = steps->east_per_column * 1e-3 + steps->east_per_row * 2e-3;
            const double north = steps->north_per_column * 1e-3 + steps->north_per_row * 2e-3;
            EXPECT_NEAR(std::hypot(east, north), line.lengthM(), 1e-4 * line.lengthM());
            const double azimuth = std::atan2(east, north) * 180.0 / std::numbers::pi;
            EXPECT_LT(std::abs(std::remainder(azimuth - line.azimuthDeg(), 360.0)), 0.01);
        }
    }
}

TEST(TerrainSlope, RefusesABaselineOfMoreThanHalfTheBody)
{
    MapMaker maker;
    const auto map = maker.make({.columns = 360,
                                 .rows = 180,
                                 .transform = {0.0, 1.0, 0.0, 90.0, 0.0, -1.0},
                                 .srs = "+proj=longlat +R=1000000"},
                                [](std::size_t, std::size_t) { return 0.0; });
    MeasuredTerrain terrain(map->georeference(), readSamples(map->heightfield()));
    JobMonitor monitor;
    const std::vector<GroundPosition> positions{{10.0, 20.0}};
    const double half_m = std::numbers::pi * 1e6;
    EXPECT_NEAR(longestBaselineM(terrain.ground()), half_m, 1e-6);
    EXPECT_TRUE(measureSlopes(terrain, positions, 0.999 * half_m, monitor));
    const auto refused = measureSlopes(terrain, positions, 1.001 * half_m, monitor);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::OutOfRange);
}

} // namespace marsview::test
