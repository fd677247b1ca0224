#include "core/raster/sample_suggestions.h"
#include "core/session/open_map.h"
#include "core/session/preview.h"
#include "tests/support/make_raster.h"
#include "tests/support/map_maker.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace marsview {
namespace {

constexpr auto kForever = std::chrono::hours(1);

std::shared_ptr<const Map> preview(const RasterSpec& spec, std::size_t samples_max)
{
    JobMonitor monitor;
    auto map = readPreview(spec, {.samples_max = samples_max, .time_max = kForever}, monitor);
    EXPECT_TRUE(map) << map.error().message;
    return map ? *map : std::shared_ptr<const Map>{};
}

std::string marsPath()
{
    return (test::bundledSamples() / "mars_mola_4ppd.tif").string();
}
std::string helensPath()
{
    return (test::bundledSamples() / "mount_st_helens_30m.tif").string();
}

MapPoint outerCorner(const Georeference& georeference, bool is_right, bool is_lower)
{
    return georeference.toMap({is_right ? static_cast<double>(georeference.columns()) - 0.5 : -0.5,
                               is_lower ? static_cast<double>(georeference.rows()) - 0.5 : -0.5});
}

// 2026-11: only the whole map suggested feet.
TEST(PreviewMap, SuggestsFeet)
{
    const test::TempFolder folder;
    std::vector<std::int16_t> samples(40 * 40, 4458);
    std::fill(samples.begin() + 800, samples.end(), std::int16_t{14176});
    test::RasterRecipe recipe = test::recipeFor(40, samples);
    recipe.srs = "EPSG:4267";
    recipe.transform = {-105.0, 0.001, 0.0, 38.0, 0.0, -0.001};
    const auto map = preview({.path = test::writeRaster(folder, "feet.tif", "GTiff", recipe)}, 100);
    ASSERT_TRUE(map);
    ASSERT_TRUE(map->isPreview());
    ASSERT_TRUE(map->info().unit_suggestion);
    EXPECT_EQ(map->info().unit_suggestion->unit.name, "ft");
    EXPECT_EQ(map->info().notices.back(), noticeOf(*map->info().unit_suggestion));
}

TEST(PreviewMap, CoversTheSameAreaAsItsMap)
{
    for (const std::string& path : {marsPath(), helensPath()}) {
        const std::shared_ptr<const Map> whole = test::loadedMap(path);
        const std::shared_ptr<const Map> small = preview({.path = path}, 5000);
        ASSERT_TRUE(small);
        const Georeference& a = whole->georeference();
        const Georeference& b = small->georeference();
        ASSERT_LT(b.columns(), a.columns());
        const double tolerance =
            1e-9 * a.transform().pixelWidth() * static_cast<double>(a.columns());
        for (const bool is_right : {false, true}) {
            for (const bool is_lower : {false, true}) {
                const MapPoint there = outerCorner(a, is_right, is_lower);
                const MapPoint here = outerCorner(b, is_right, is_lower);
                EXPECT_NEAR(here.x, there.x, tolerance) << path;
                EXPECT_NEAR(here.y, there.y, tolerance) << path;
            }
        }
        EXPECT_EQ(a.wrapsAround(), b.wrapsAround()) << path;
        // The scenes agree, so a camera has the same view in both.
        const double side_m = a.pixelWidthMeters() * static_cast<double>(a.columns());
        const ScenePoint in_a = a.sceneFrame().toScene({-0.5, -0.5}, 0.0);
        const ScenePoint in_b = b.sceneFrame().toScene({-0.5, -0.5}, 0.0);
        EXPECT_NEAR(in_a.x, in_b.x, 1e-9 * side_m) << path;
        EXPECT_NEAR(in_a.y, in_b.y, 1e-9 * side_m) << path;
    }
}

TEST(PreviewMap, HasTheHeightsOfTheMapAtItsSamples)
{
    for (const std::string& path : {marsPath(), helensPath()}) {
        const std::shared_ptr<const Map> whole = test::loadedMap(path);
        const std::shared_ptr<const Map> small = preview({.path = path}, 5000);
        ASSERT_TRUE(small);
        const Heightfield& truth = whole->heightfield();
        const Heightfield& heights = small->heightfield();
        for (std::size_t j = 0; j < heights.rows(); ++j) {
            for (std::size_t i = 0; i < heights.columns(); ++i) {
                // Through the position that the preview gives for the sample.
                const MapPoint at =
                    small->georeference().toMap({static_cast<double>(i), static_cast<double>(j)});
                const GridPoint place = whole->georeference().toGrid(at);
                const auto column = decimatedPlace(i, heights.columns(), truth.columns());
                const auto row = decimatedPlace(j, heights.rows(), truth.rows());
                EXPECT_LE(std::abs(place.column - static_cast<double>(column)), 0.5 + 1e-6);
                EXPECT_LE(std::abs(place.row - static_cast<double>(row)), 0.5 + 1e-6);
                const double expected = truth.sample(column, row);
                ASSERT_TRUE(heights.sample(i, j) == expected ||
                            (std::isnan(expected) && std::isnan(heights.sample(i, j))));
            }
        }
    }
}

TEST(PreviewMap, DescribesTheWholeFileAndIsMarkedAsAPreview)
{
    const std::shared_ptr<const Map> whole = test::loadedMap(marsPath());
    const std::shared_ptr<const Map> small = preview({.path = marsPath()}, 5000);
    ASSERT_TRUE(small);
    EXPECT_TRUE(small->isPreview());
    EXPECT_FALSE(whole->isPreview());
    const RasterInfo& info = small->info();
    EXPECT_EQ(info.columns, whole->info().columns);
    EXPECT_EQ(info.rows, whole->info().rows);
    EXPECT_EQ(info.transform, whole->info().transform);
    EXPECT_EQ(info.body, whole->info().body);
    EXPECT_EQ(info.vertical_datum, whole->info().vertical_datum);
    ASSERT_FALSE(info.notices.empty());
    EXPECT_NE(info.notices.front().find("a preview of"), std::string::npos);
    EXPECT_TRUE(isOfSameMap(*small, *whole));
    EXPECT_FALSE(isOfSameMap(*whole, *whole));
    EXPECT_FALSE(isOfSameMap(*small, *test::loadedMap(helensPath())));
}

TEST(PreviewMap, AppliesOverrides)
{
    RasterSpec spec{.path = helensPath()};
    spec.overrides.vertical_unit = "ft";
    spec.overrides.transform = {{100.0, 2.0, 0.0, 200.0, 0.0, -3.0}};
    const std::shared_ptr<const Map> small = preview(spec, 3000);
    ASSERT_TRUE(small);
    const Georeference& georeference = small->georeference();
    const MapPoint corner = outerCorner(georeference, true, true);
    EXPECT_NEAR(corner.x, 100.0 + 2.0 * static_cast<double>(small->info().columns), 1e-6);
    EXPECT_NEAR(corner.y, 200.0 - 3.0 * static_cast<double>(small->info().rows), 1e-6);
    // And others afterwards, without being read again.
    const auto later = test::overridden(*small, {});
    ASSERT_TRUE(later);
    EXPECT_TRUE((*later)->isPreview());
    EXPECT_EQ((*later)->info().columns, small->info().columns);
    const std::shared_ptr<const Map> plain = preview({.path = helensPath()}, 3000);
    EXPECT_EQ((*later)->georeference().transform(), plain->georeference().transform());
    EXPECT_NEAR((*later)->heightfield().sample(3, 3), small->heightfield().sample(3, 3) / 0.3048,
                1e-6);
    EXPECT_EQ((*later)->info().notices, plain->info().notices);
}

TEST(PreviewMap, PlacesFilesWithoutPlacementInPixels)
{
    const test::TempFolder folder;
    test::RasterRecipe recipe = test::recipeFor(200, std::vector<float>(200 * 100, 7.0F));
    recipe.transform.reset();
    const std::string path = test::writeRaster(folder, "bare.tif", "GTiff", recipe);
    const std::shared_ptr<const Map> small = preview({.path = path}, 200);
    ASSERT_TRUE(small);
    EXPECT_EQ(small->georeference().columns(), 20U);
    const MapPoint corner = outerCorner(small->georeference(), true, true);
    EXPECT_NEAR(corner.x, 200.0, 1e-9);
    EXPECT_NEAR(corner.y, -100.0, 1e-9);
}

TEST(PreviewMap, IsRefusedIfNoHeightIsFound)
{
    const test::TempFolder folder;
    test::RasterRecipe recipe = test::recipeFor(200, std::vector<float>(200 * 100, -9.0F));
    recipe.band_xml = "<NoDataValue>-9</NoDataValue>";
    const std::string path = test::writeRaster(folder, "void.tif", "GTiff", recipe);
    JobMonitor monitor;
    const auto map = readPreview(RasterSpec{.path = path}, {.samples_max = 200}, monitor);
    ASSERT_FALSE(map);
    EXPECT_EQ(map.error().code, ErrorCode::Invalid);
    EXPECT_EQ(map.error().message.find(path + ": "), 0U);
    const auto missing =
        readPreview(RasterSpec{.path = "/no/such/map.tif"}, {.samples_max = 200}, monitor);
    ASSERT_FALSE(missing);
}

} // namespace
} // namespace marsview
