#include "core/session/open_map.h"
#include "core/session/preview_map.h"
#include "tests/support/make_raster.h"
#include "tests/support/map_maker.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace marsview {
namespace {

constexpr auto kForever = std::chrono::hours(1);

LoadedMap preview(const DatasetSpec& spec, std::size_t samples_max)
{
    JobMonitor monitor;
    auto map = readPreview(spec, {.samples_max = samples_max, .time_max = kForever}, monitor);
    EXPECT_TRUE(map) << map.error().message;
    return map ? *map : LoadedMap{};
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

TEST(PreviewMap, CoversTheSameGroundAsItsMap)
{
    for (const std::string& path : {marsPath(), helensPath()}) {
        const LoadedMap whole = test::loadedMap(path);
        const LoadedMap small = preview({.path = path}, 5000);
        ASSERT_TRUE(small);
        const Georeference& a = whole.dataset->georeference();
        const Georeference& b = small.dataset->georeference();
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
        // The scenes agree, so that a camera sees the same in either.
        const double side_m = a.pixelWidthMetres() * static_cast<double>(a.columns());
        const ScenePoint in_a = a.sceneFrame().toScene({-0.5, -0.5}, 0.0);
        const ScenePoint in_b = b.sceneFrame().toScene({-0.5, -0.5}, 0.0);
        EXPECT_NEAR(in_a.x, in_b.x, 1e-9 * side_m) << path;
        EXPECT_NEAR(in_a.y, in_b.y, 1e-9 * side_m) << path;
    }
}

TEST(PreviewMap, HasTheHeightsOfItsMapAtItsSamples)
{
    for (const std::string& path : {marsPath(), helensPath()}) {
        const LoadedMap whole = test::loadedMap(path);
        const LoadedMap small = preview({.path = path}, 5000);
        ASSERT_TRUE(small);
        const Heightfield& truth = whole.dataset->heightfield();
        const Heightfield& heights = small.dataset->heightfield();
        for (std::size_t j = 0; j < heights.rows(); ++j) {
            for (std::size_t i = 0; i < heights.columns(); ++i) {
                // By way of the ground: where the sample says that it lies.
                const MapPoint at = small.dataset->georeference().toMap(
                    {static_cast<double>(i), static_cast<double>(j)});
                const GridPoint place = whole.dataset->georeference().toGrid(at);
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

TEST(PreviewMap, TellsOfTheWholeFileAndThatItIsAPreview)
{
    const LoadedMap whole = test::loadedMap(marsPath());
    const LoadedMap small = preview({.path = marsPath()}, 5000);
    ASSERT_TRUE(small);
    EXPECT_TRUE(small.dataset->isPreview());
    EXPECT_FALSE(whole.dataset->isPreview());
    const RasterInfo& info = small.dataset->info();
    EXPECT_EQ(info.columns, whole.dataset->info().columns);
    EXPECT_EQ(info.rows, whole.dataset->info().rows);
    EXPECT_EQ(info.transform, whole.dataset->info().transform);
    EXPECT_EQ(info.body, whole.dataset->info().body);
    EXPECT_EQ(info.vertical_datum, whole.dataset->info().vertical_datum);
    ASSERT_FALSE(info.notices.empty());
    EXPECT_NE(info.notices.front().find("a preview of"), std::string::npos);
    EXPECT_TRUE(isOfSameMap(*small.dataset, *whole.dataset));
    EXPECT_FALSE(isOfSameMap(*whole.dataset, *whole.dataset));
    EXPECT_FALSE(isOfSameMap(*small.dataset, *test::loadedMap(helensPath()).dataset));
}

TEST(PreviewMap, TakesOverrides)
{
    DatasetSpec spec{.path = helensPath()};
    spec.overrides.vertical_unit = "ft";
    spec.overrides.transform = {{100.0, 2.0, 0.0, 200.0, 0.0, -3.0}};
    const LoadedMap small = preview(spec, 3000);
    ASSERT_TRUE(small);
    const Georeference& georeference = small.dataset->georeference();
    const MapPoint corner = outerCorner(georeference, true, true);
    EXPECT_NEAR(corner.x, 100.0 + 2.0 * static_cast<double>(small.dataset->info().columns), 1e-6);
    EXPECT_NEAR(corner.y, 200.0 - 3.0 * static_cast<double>(small.dataset->info().rows), 1e-6);
    // And others afterwards, without being read again.
    const auto later = withOverrides(*small.dataset, {});
    ASSERT_TRUE(later);
    EXPECT_TRUE((*later)->isPreview());
    EXPECT_EQ((*later)->info().columns, small.dataset->info().columns);
    const LoadedMap plain = preview({.path = helensPath()}, 3000);
    EXPECT_EQ((*later)->georeference().transform(), plain.dataset->georeference().transform());
    EXPECT_NEAR((*later)->heightfield().sample(3, 3),
                small.dataset->heightfield().sample(3, 3) / 0.3048, 1e-6);
    EXPECT_EQ((*later)->info().notices, plain.dataset->info().notices);
}

TEST(PreviewMap, PlacesFilesWithoutAnyPlaceInPixels)
{
    const test::TempFolder folder;
    test::RasterRecipe recipe = test::recipeFor(200, std::vector<float>(200 * 100, 7.0F));
    recipe.transform.reset();
    const std::string path = test::writeRaster(folder, "bare.tif", "GTiff", recipe);
    const LoadedMap small = preview({.path = path}, 200);
    ASSERT_TRUE(small);
    EXPECT_EQ(small.dataset->georeference().columns(), 20U);
    const MapPoint corner = outerCorner(small.dataset->georeference(), true, true);
    EXPECT_NEAR(corner.x, 200.0, 1e-9);
    EXPECT_NEAR(corner.y, -100.0, 1e-9);
}

TEST(PreviewMap, IsRefusedWhereNoHeightIsFound)
{
    const test::TempFolder folder;
    test::RasterRecipe recipe = test::recipeFor(200, std::vector<float>(200 * 100, -9.0F));
    recipe.band_xml = "<NoDataValue>-9</NoDataValue>";
    const std::string path = test::writeRaster(folder, "void.tif", "GTiff", recipe);
    JobMonitor monitor;
    const auto map = previewMap({.path = path}, 200, monitor);
    ASSERT_FALSE(map);
    EXPECT_EQ(map.error().code, ErrorCode::Invalid);
    EXPECT_EQ(map.error().message.find(path + ": "), 0U);
    const auto missing = previewMap({.path = "/no/such/map.tif"}, 200, monitor);
    ASSERT_FALSE(missing);
}

} // namespace
} // namespace marsview
