#include "core/raster/raster_file.h"
#include "core/session/map.h"
#include "tests/support/make_raster.h"
#include "tests/support/map_maker.h"
#include "tests/support/random.h"
#include "tests/support/reference_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace marsview {
namespace {

using test::RasterRecipe;
using test::recipeFor;
using test::TempFolder;
using test::writeRaster;

std::shared_ptr<const Map> load(const std::string& path, const RasterOverrides& overrides = {})
{
    JobMonitor monitor;
    auto dataset = readMap(RasterSpec{path, 1, overrides}, monitor, std::size_t{1} << 30);
    EXPECT_TRUE(dataset) << dataset.error().message;
    return dataset ? *dataset : nullptr;
}

constexpr std::size_t kColumns = 36;
constexpr std::size_t kRows = 18;

struct GlobalMap {
    TempFolder folder;
    std::vector<float> samples;
    std::string path;

    explicit GlobalMap(double west_deg = 0.0)
    {
        test::Random random;
        for (std::size_t i = 0; i < kColumns * kRows; ++i) {
            samples.push_back(static_cast<float>(random.uniform(-8000.0, 21000.0)));
        }
        RasterRecipe recipe = recipeFor(kColumns, samples);
        recipe.transform = {west_deg, 10.0, 0.0, 90.0, 0.0, -10.0};
        recipe.srs = "IAU_2015:49900";
        path = writeRaster(folder, "mars.tif", "GTiff", recipe);
    }

    long double sample(std::size_t column, std::size_t row) const
    {
        return static_cast<long double>(samples[row * kColumns + column % kColumns]);
    }
};

double heightAt(const Map& dataset, double longitude_deg, double latitude_deg)
{
    return dataset.height({Angle::degrees(longitude_deg), Angle::degrees(latitude_deg)});
}

TEST(Map, InterpolatesAcrossTheSeamOfAGlobalMap)
{
    for (const double west_deg : {0.0, -180.0, 20.0}) {
        const GlobalMap map(west_deg);
        const auto dataset = load(map.path);
        ASSERT_TRUE(dataset);
        ASSERT_TRUE(dataset->georeference().wrapsAround());
        test::Random random;
        for (int i = 0; i < 4000; ++i) {
            // Columns of an endlessly repeated map, many of them at the seam.
            const double column =
                random.chance(0.5) ? random.uniform(34.9, 36.1) : random.uniform(0.0, 36.0);
            const double row = random.uniform(0.0, 17.0);
            const double longitude =
                west_deg + (column + 0.5) * 10.0 + 360.0 * std::floor(random.uniform(-2.0, 3.0));
            const double latitude = 90.0 - (row + 0.5) * 10.0;
            const auto c = static_cast<std::size_t>(column);
            const auto r = static_cast<std::size_t>(row);
            const long double expected =
                test::planeHeight({map.sample(c, r), map.sample(c + 1, r), map.sample(c, r + 1),
                                   map.sample(c + 1, r + 1)},
                                  column - static_cast<double>(c), row - static_cast<double>(r));
            // Rounding of 1e-13 degrees, over cells of 10 degrees and 29 km of relief.
            ASSERT_NEAR(heightAt(*dataset, longitude, latitude), static_cast<double>(expected),
                        1e-7)
                << longitude << " " << latitude;
        }
    }
}

TEST(Map, FindsEverySampleOfAGlobalMapByLongitudeAndLatitude)
{
    const GlobalMap map;
    const auto dataset = load(map.path);
    ASSERT_TRUE(dataset);
    for (std::size_t r = 0; r < kRows; ++r) {
        for (std::size_t c = 0; c < kColumns; ++c) {
            const auto place = dataset->georeference().toGeographic(
                GridPoint{static_cast<double>(c), static_cast<double>(r)});
            ASSERT_TRUE(place);
            ASSERT_NEAR(dataset->height(*place), static_cast<double>(map.sample(c, r)), 1e-7)
                << c << " " << r;
        }
    }
}

// Rounding of the conversions must not put a sample of the map's edge outside the map.
TEST(Map, FindsTheOutermostSamplesByLongitudeAndLatitude)
{
    const struct {
        const char* srs;
        std::array<double, 6> transform;
    } cases[] = {
        {"EPSG:32610", {557805.0, 30.0, 0.0, 5121975.0, 0.0, -30.0}},
        {"EPSG:32610", {557805.0, 26.0, 15.0, 5121975.0, 15.0, -26.0}},
        {"EPSG:3031", {-100000.0, 500.0, 0.0, 200000.0, 0.0, -500.0}},
        {"EPSG:4326", {-122.3, 1.0 / 3600.0, 0.0, 46.3, 0.0, -1.0 / 3600.0}},
        {"IAU_2015:49910", {100.0, 231.5, 0.0, 1e6, 0.0, -231.5}},
    };
    for (const auto& c : cases) {
        const TempFolder folder;
        RasterRecipe recipe = recipeFor(kColumns, std::vector<float>(kColumns * kRows, 7.0F));
        recipe.transform = c.transform;
        recipe.srs = c.srs;
        const auto dataset = load(writeRaster(folder, "map.tif", "GTiff", recipe));
        ASSERT_TRUE(dataset);
        std::size_t lost = 0;
        for (std::size_t r = 0; r < kRows; ++r) {
            for (std::size_t col = 0; col < kColumns; ++col) {
                const auto place = dataset->georeference().toGeographic(
                    GridPoint{static_cast<double>(col), static_cast<double>(r)});
                ASSERT_TRUE(place);
                lost += std::isnan(dataset->height(*place)) ? 1U : 0U;
            }
        }
        EXPECT_EQ(lost, 0U) << c.srs << ": samples without an elevation at their own position";
    }
}

TEST(Map, IsNanOutsideAndForNan)
{
    const TempFolder folder;
    RasterRecipe recipe = recipeFor(kColumns, std::vector<float>(kColumns * kRows, 7.0F));
    recipe.transform = {557805.0, 30.0, 0.0, 5121975.0, 0.0, -30.0};
    recipe.srs = "EPSG:32610";
    const auto dataset = load(writeRaster(folder, "map.tif", "GTiff", recipe));
    ASSERT_TRUE(dataset);
    EXPECT_TRUE(std::isnan(heightAt(*dataset, 0.0, 0.0)));
    EXPECT_TRUE(std::isnan(heightAt(*dataset, -122.2, 46.2)));
    EXPECT_TRUE(std::isnan(heightAt(*dataset, std::nan(""), 46.0)));
    EXPECT_TRUE(std::isnan(heightAt(*dataset, -122.2, std::nan(""))));
    EXPECT_TRUE(std::isnan(heightAt(*dataset, INFINITY, 46.0)));
}

// ---- Overrides: a rejected one leaves everything unchanged -----------------------------------

TEST(DatasetOverrides, AreAppliedWithoutReadingTheFileAgain)
{
    const GlobalMap map;
    const auto before = load(map.path);
    ASSERT_TRUE(before);
    RasterOverrides overrides;
    overrides.vertical_unit = "km";
    const auto after = test::overridden(*before, overrides);
    ASSERT_TRUE(after) << after.error().message;
    EXPECT_EQ(&(*after)->heightfield().samples(), &before->heightfield().samples());
    EXPECT_EQ((*after)->heightfield().sample(3, 4), before->heightfield().sample(3, 4) * 1000.0);
    EXPECT_EQ((*after)->spec().overrides, overrides);
    EXPECT_EQ((*after)->fileInfo().unit.name, "m");
    // And taken back.
    const auto again = test::overridden(**after, {});
    ASSERT_TRUE(again);
    EXPECT_EQ((*again)->heightfield().sample(3, 4), before->heightfield().sample(3, 4));
    EXPECT_TRUE((*again)->spec().overrides.isEmpty());
}

TEST(DatasetOverrides, LeaveTheMapUnchangedIfTheyAreRefused)
{
    const GlobalMap map;
    const auto dataset = load(map.path);
    ASSERT_TRUE(dataset);
    const double height = heightAt(*dataset, 226.2, 18.65);
    const std::string crs = dataset->info().crs->wkt();
    std::vector<RasterOverrides> bad(7);
    bad[0].crs = "EPSG:99999999";
    bad[1].body = "Vulcan";
    bad[2].vertical_unit = "parsec";
    bad[3].ellipsoid = Ellipsoid{0.0, 0.0};
    bad[4].ellipsoid = Ellipsoid{3396190.0, std::nan("")};
    bad[5].transform = GeoTransform::Terms{0, 0, 0, 0, 0, 0};
    bad[6].nodata = -9999.0;
    for (std::size_t i = 0; i < bad.size(); ++i) {
        const auto refused = test::overridden(*dataset, bad[i]);
        ASSERT_FALSE(refused) << i;
        EXPECT_TRUE(refused.error().message.starts_with(map.path)) << refused.error().message;
        EXPECT_EQ(refused.error().message.find('\n'), std::string::npos);
        EXPECT_EQ(heightAt(*dataset, 226.2, 18.65), height);
        EXPECT_EQ(dataset->info().crs->wkt(), crs);
        EXPECT_TRUE(dataset->spec().overrides.isEmpty());
        if (i < 6) {
            JobMonitor monitor;
            const auto loaded =
                readMap(RasterSpec{map.path, 1, bad[i]}, monitor, std::size_t{1} << 30);
            ASSERT_FALSE(loaded) << i;
            EXPECT_TRUE(loaded.error().message.starts_with(map.path)) << loaded.error().message;
        }
    }
}

TEST(DatasetOverrides, ApplyNodataWhenTheFileIsRead)
{
    const GlobalMap map;
    RasterOverrides overrides;
    overrides.nodata = static_cast<double>(map.samples[40]);
    const auto dataset = load(map.path, overrides);
    ASSERT_TRUE(dataset);
    EXPECT_TRUE(std::isnan(dataset->heightfield().sample(40 % kColumns, 40 / kColumns)));
    EXPECT_FALSE(std::isnan(dataset->heightfield().sample(0, 0)));
}

TEST(Map, WithoutPlacementEachPixelIsAUnitSquare)
{
    const TempFolder folder;
    RasterRecipe recipe = recipeFor<float>(3, {1, 2, 3, 4, 5, 6});
    recipe.transform.reset();
    const auto dataset = load(writeVrt(folder, "map", recipe));
    ASSERT_TRUE(dataset);
    EXPECT_EQ(dataset->georeference().toMap({1.0, 1.0}), (MapPoint{1.5, -1.5}));
    EXPECT_EQ(dataset->georeference().pixelWidthMeters(), 1.0);
}

} // namespace
} // namespace marsview
