#include "core/raster/crs_suggestion.h"
#include "core/raster/raster_file.h"
#include "core/raster/raster_info.h"
#include "tests/support/make_raster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace marsview {
namespace {

using testing::HasSubstr;

RasterInfo gridAt(double west, double north, double pixel, std::size_t columns, std::size_t rows)
{
    RasterInfo info;
    info.columns = columns;
    info.rows = rows;
    info.transform = *GeoTransform::fromTerms({west, pixel, 0, north, 0, -pixel});
    return info;
}

TEST(CrsSuggestion, IsOfferedForGridsThatLookLikeDegrees)
{
    const std::vector<RasterInfo> grids{
        gridAt(0, 90, 1.0, 360, 180),                                     // the whole body, from 0
        gridAt(-180, 90, 0.25, 1440, 720),                                // and from -180
        gridAt(20, 90, 1.0, 360, 180),                                    // and from any meridian
        gridAt(-0.5, 90.5, 1.0, 361, 181),                                // samples on the poles
        gridAt(-1.0 / 24, 90 + 1.0 / 24, 1.0 / 12, 4320, 2161),           // ETOPO5
        gridAt(-105.550416666684, 40.2104166666, 1.0 / 1200, 240, 144),   // SRTM
        gridAt(-100.041666666667, 40.0416666667, 0.0833333333, 480, 600), // GTOPO30's layout
        // 30 m, layout of some program
        gridAt(-122.2, 43.0, 0.000269965979, 429, 279),
    };
    for (const RasterInfo& grid : grids) {
        const auto suggestion = suggestCrs(grid);
        ASSERT_TRUE(suggestion) << grid.transform->terms()[0];
        ASSERT_EQ(suggestion->choices.size(), 3U);
        EXPECT_EQ(suggestion->choices[0], (CrsChoice{"Earth", "EPSG:4326"}));
        EXPECT_EQ(suggestion->choices[1], (CrsChoice{"Mars", "IAU_2015:49902"}));
        EXPECT_EQ(suggestion->choices[2], (CrsChoice{"Moon", "IAU_2015:30100"}));
    }
}

TEST(CrsSuggestion, IsNotOfferedForGridsInMeters)
{
    const std::vector<RasterInfo> grids{
        gridAt(500000, 4100000, 30, 100, 100), // UTM
        gridAt(0, 550, 10, 76, 55),            // a site with its origin at its corner
        gridAt(0, 50, 0.5, 100, 100),          // a trench
        gridAt(-40, 40, 0.1, 800, 800),        // around its own origin
        gridAt(10, 60, 1, 50, 50),             // cells of 1 m
        gridAt(-90, 45, 30, 6, 3),             // too coarse for degrees
        gridAt(-720.5, 90, 0.5, 2880, 360),    // two full turns of longitude
    };
    for (const RasterInfo& grid : grids) {
        EXPECT_FALSE(suggestCrs(grid)) << grid.transform->terms()[0];
    }
    RasterInfo placed = gridAt(0, 90, 1, 360, 180);
    placed.crs = *Crs::fromText("EPSG:4326");
    EXPECT_FALSE(suggestCrs(placed));
    RasterInfo nowhere = gridAt(0, 90, 1, 360, 180);
    nowhere.transform.reset();
    EXPECT_FALSE(suggestCrs(nowhere));
}

// GDAL gives GeoTIFF files that name no CRS a local one in an unknown unit.
TEST(CrsSuggestion, IsOfferedForAFileWithAStandInForACrs)
{
    const test::TempFolder folder;
    test::RasterRecipe recipe =
        test::recipeFor(240, std::vector<std::int16_t>(std::size_t{240} * 144, 100));
    recipe.transform = {-105.5, 1.0 / 1200, 0.0, 40.25, 0.0, -1.0 / 1200};
    recipe.srs = "LOCAL_CS[\"unnamed\",UNIT[\"unknown\",1]]";
    const auto degrees = RasterFile::open(test::writeVrt(folder, "degrees", recipe));
    ASSERT_TRUE(degrees) << degrees.error().message;
    EXPECT_FALSE(degrees->info().crs);
    EXPECT_TRUE(suggestCrs(degrees->info()));
    recipe.srs = "LOCAL_CS[\"site\",UNIT[\"metre\",1]]";
    const auto site = RasterFile::open(test::writeVrt(folder, "site", recipe));
    ASSERT_TRUE(site) << site.error().message;
    EXPECT_TRUE(site->info().crs) << "a unit is information";
}

TEST(CrsSuggestion, FollowsDeclaredAxesAndTheBodyOfTheFile)
{
    RasterInfo tile = gridAt(0, 10, 2, 5, 5); // could be meters as well
    EXPECT_FALSE(suggestCrs(tile));
    tile.axis_hints.degree_axes = "its axes are lon in degrees_east and lat in degrees_north";
    tile.axis_hints.body = bodyNamed("Moon");
    const auto suggestion = suggestCrs(tile);
    ASSERT_TRUE(suggestion);
    EXPECT_TRUE(suggestion->is_certain);
    EXPECT_EQ(suggestion->reason, tile.axis_hints.degree_axes);
    EXPECT_EQ(suggestion->choices, (std::vector<CrsChoice>{{"Moon", "IAU_2015:30100"}}));
}

TEST(CrsSuggestion, EveryChoiceGivesTheCrsOfItsBody)
{
    for (const Body& body : knownBodies()) {
        RasterInfo grid = gridAt(0, 90, 1, 360, 180);
        grid.axis_hints.body = &body;
        const auto suggestion = suggestCrs(grid);
        ASSERT_TRUE(suggestion) << body.name;
        ASSERT_EQ(suggestion->choices.size(), 1U);
        RasterOverrides by_crs;
        by_crs.crs = suggestion->choices[0].crs;
        RasterOverrides by_body;
        by_body.body = std::string(body.name);
        const auto first = withOverrides(grid, by_crs);
        const auto second = withOverrides(grid, by_body);
        ASSERT_TRUE(first && second) << body.name;
        EXPECT_EQ(first->body, &body);
        EXPECT_EQ(first->crs->latitudeKind(), second->crs->latitudeKind()) << body.name;
        EXPECT_NEAR(first->crs->ellipsoid()->equatorial_m, body.ellipsoid.equatorial_m, 1e-3);
        EXPECT_NEAR(first->crs->ellipsoid()->polar_m, body.ellipsoid.polar_m, 1e-3) << body.name;
        EXPECT_FALSE(first->crs_suggestion);
    }
}

TEST(CrsSuggestion, IsANoticeUntilTheCrsIsSet)
{
    const RasterInfo grid = gridAt(0, 90, 1, 360, 180);
    const auto bare = withOverrides(grid, {});
    ASSERT_TRUE(bare && bare->crs_suggestion);
    EXPECT_THAT(bare->notices, testing::ElementsAre(noticeOf(*bare->crs_suggestion)));
    EXPECT_EQ(noticeOf(*bare->crs_suggestion),
              "no CRS, but it looks like longitude and latitude in degrees (its extent is 0° – "
              "360°, 90° S – 90° N): set EPSG:4326 (Earth), IAU_2015:49902 (Mars) or "
              "IAU_2015:30100 (Moon); until then, map units are read as meters");
    EXPECT_THAT(optionNoticeOf(*bare->crs_suggestion),
                HasSubstr("set the CRS with --crs EPSG:4326 (Earth), --crs IAU_2015:49902 (Mars)"));
    RasterOverrides overrides;
    overrides.crs = bare->crs_suggestion->choices[0].crs;
    const auto set = withOverrides(grid, overrides);
    ASSERT_TRUE(set);
    EXPECT_FALSE(set->crs_suggestion);
    EXPECT_TRUE(set->notices.empty()) << set->notices.front();
    // With a geotransform in meters there is nothing to suggest.
    RasterOverrides meters;
    meters.transform = GeoTransform::Terms{5e5, 30, 0, 4e6, 0, -30};
    EXPECT_FALSE(withOverrides(grid, meters)->crs_suggestion);
}

TEST(CrsSuggestion, NoticeNamesTheSideOfTheMeridian)
{
    EXPECT_EQ(suggestCrs(gridAt(-105.5, 40.25, 1.0 / 1200, 240, 144))->reason,
              "its extent is 105.5° W – 105.3° W, 40.13° N – 40.25° N");
    EXPECT_EQ(suggestCrs(gridAt(-180, 0, 0.25, 1440, 360))->reason,
              "its extent is 180° W – 180° E, 90° S – 0°");
    // Half a sample before 0: with a true minus sign.
    EXPECT_EQ(suggestCrs(gridAt(-1.0 / 2400, 40.25, 1.0 / 1200, 240, 144))->reason,
              "its extent is −0.0004° – 0.1996°, 40.13° N – 40.25° N");
}

struct Placed {
    const char* name;
    RasterInfo grid;
    const char* crs;
    bool is_accepted;
};

TEST(CrsOverride, IsRefusedIfItsUnitDoesNotFitTheGrid)
{
    RasterInfo in_degrees = gridAt(0, 90, 0.25, 1440, 720);
    in_degrees.crs = *Crs::fromText("IAU_2015:49900");
    RasterInfo misplaced = gridAt(499980, 4200000, 30, 100, 100);
    misplaced.crs = *Crs::fromText("EPSG:4326"); // what the file declares, wrongly
    RasterInfo axes = gridAt(10, 50, 1, 20, 20);
    axes.axis_hints.degree_axes = "its axes are x in degrees_east and y in degrees_north";
    const std::vector<Placed> cases{
        {"degrees on UTM", gridAt(499980, 4200000, 30, 100, 100), "EPSG:4326", false},
        {"beyond the pole by samples", gridAt(0, 93, 1, 360, 180), "EPSG:4326", false},
        {"beyond two turns", gridAt(700, 10, 1, 60, 20), "EPSG:4326", false},
        {"degrees on a site of metres", gridAt(0, 550, 10, 76, 55), "IAU_2015:49900", false},
        {"projection on a whole body", gridAt(0, 90, 1, 360, 180), "EPSG:32610", false},
        {"projection on a tile of seconds", gridAt(-72, 45, 1.0 / 1200.0, 1200, 1200), "EPSG:32632",
         false},
        {"projection on declared degrees", axes, "EPSG:32610", false},
        {"projection in place of degrees", in_degrees, "EPSG:32610", false},
        {"0 to 360", gridAt(0, 90, 1, 360, 180), "EPSG:4326", true},
        {"samples on the poles", gridAt(-0.5, 90.5, 1, 361, 181), "EPSG:4326", true},
        {"another turn", gridAt(200, 10, 1, 360, 20), "EPSG:4326", true},
        {"other degrees", in_degrees, "EPSG:4326", true},
        {"metres near the origin", gridAt(-40, 40, 0.1, 800, 800), "IAU_2015:30135", true},
        {"40 by 50 degrees on UTM", gridAt(10, 60, 1, 40, 50), "EPSG:32633", false},
        {"degrees on UTM without a registered area", gridAt(5, 60, 0.25, 120, 80),
         "+proj=tmerc +lon_0=8 +k=0.9997 +x_0=500000 +R=3396190 +no_defs", false},
        {"degrees on a national grid", gridAt(6, 48, 1.0 / 120, 480, 240), "EPSG:2056", false},
        {"metres of some site", gridAt(10, 60, 1, 50, 50), "IAU_2015:49910", true},
        {"metres of UTM", gridAt(500010, 60, 1, 50, 50), "EPSG:32610", true},
        {"metres across the antimeridian", gridAt(500010, 60, 1, 50, 50), "EPSG:32601", true},
        {"metres in place of wrong degrees", misplaced, "EPSG:32610", true},
    };
    for (const Placed& one : cases) {
        RasterOverrides overrides;
        overrides.crs = one.crs;
        const auto info = withOverrides(one.grid, overrides);
        ASSERT_EQ(info.has_value(), one.is_accepted)
            << one.name << ": " << (info ? "" : info.error().message);
        if (!info) {
            EXPECT_EQ(refusedField(info.error()), OverrideField::Crs) << info.error().message;
            EXPECT_THAT(info.error().message, HasSubstr("cannot place a grid"));
        }
    }
}

TEST(CrsOverride, OfAProjectionOnAGridThatOnlyLooksLikeDegreesIsReported)
{
    RasterOverrides overrides;
    overrides.crs = "EPSG:3857"; // of which these are lengths near its origin
    for (const RasterInfo& grid : {gridAt(5, 60, 0.25, 120, 80), gridAt(10, 60, 1, 40, 50)}) {
        const auto info = withOverrides(grid, overrides);
        ASSERT_TRUE(info) << info.error().message;
        EXPECT_THAT(info->notices,
                    testing::Contains(testing::HasSubstr("looks like longitude and latitude")));
    }
}

TEST(CrsOverride, OfAProjectionIsRefusedWithAGeotransformInDegrees)
{
    RasterInfo lengths = gridAt(499980, 4200000, 30, 40, 50);
    lengths.crs = *Crs::fromText("EPSG:32633");
    RasterOverrides overrides;
    overrides.transform = GeoTransform::Terms{10, 1, 0, 60, 0, -1};
    const auto alone = withOverrides(lengths, overrides);
    ASSERT_FALSE(alone);
    EXPECT_EQ(refusedField(alone.error()), OverrideField::Transform) << alone.error().message;
    overrides.crs = "EPSG:32633";
    const auto both = withOverrides(gridAt(0, 1, 1, 40, 50), overrides);
    ASSERT_FALSE(both);
    EXPECT_EQ(refusedField(both.error()), OverrideField::Crs) << both.error().message;
    EXPECT_THAT(both.error().message, HasSubstr("cannot place a grid"));
}

TEST(CrsNotice, OfAFileWithAProjectionAndAGridInDegrees)
{
    RasterInfo grid = gridAt(10, 60, 1, 40, 50);
    grid.crs = *Crs::fromText("EPSG:32633");
    EXPECT_THAT(withOverrides(grid, {})->notices,
                testing::ElementsAre(HasSubstr("cannot place a grid that covers x 10 to 50")));
    RasterInfo seconds = gridAt(499980, 4200000, 1.0 / 3600.0, 100, 100);
    seconds.crs = grid.crs;
    EXPECT_THAT(withOverrides(seconds, {})->notices,
                testing::ElementsAre(HasSubstr("as if it were in degrees")));
    RasterInfo lengths = gridAt(499980, 4200000, 30, 100, 100);
    lengths.crs = grid.crs;
    EXPECT_THAT(withOverrides(lengths, {})->notices, testing::IsEmpty());
    RasterInfo fine = gridAt(499980, 4200000, 0.005, 100, 100); // from a drone
    fine.crs = grid.crs;
    EXPECT_THAT(withOverrides(fine, {})->notices, testing::IsEmpty());
}

TEST(CrsNotice, OfAFileWithDegreesOnAGridInMetersThatIsReadWithoutACrs)
{
    RasterInfo grid = gridAt(376313.6554542635, 3350820, 30, 100, 200);
    grid.crs = *Crs::fromText("IAU_2015:49900");
    grid.body = grid.crs->body();
    const auto info = withOverrides(grid, {});
    ASSERT_TRUE(info) << info.error().message;
    EXPECT_FALSE(info->crs);
    EXPECT_EQ(info->body, bodyNamed("Mars"));
    EXPECT_THAT(info->notices, testing::ElementsAre(info->unused_crs_notice));
    EXPECT_EQ(info->unused_crs_notice,
              "the CRS \"Mars (2015) - Sphere / Ocentric\" of the file is not used: it is in "
              "degrees, but the grid covers x 376314 to 379314 and y 3344820 to 3350820; set the "
              "CRS; until then, map units are read as meters");
    RasterOverrides overrides;
    overrides.body = "Moon"; // is not a placement
    EXPECT_FALSE(withOverrides(grid, overrides)->crs);
    EXPECT_EQ(withOverrides(grid, overrides)->body, bodyNamed("Moon"));
    overrides.body.reset();
    overrides.crs = "IAU_2015:49910";
    const auto placed = withOverrides(grid, overrides);
    ASSERT_TRUE(placed && placed->crs);
    EXPECT_THAT(placed->notices, testing::IsEmpty());
    overrides.crs.reset();
    overrides.transform = GeoTransform::Terms{0, 0.1, 0, 10, 0, -0.1}; // that of its CRS
    const auto in_degrees = withOverrides(grid, overrides);
    ASSERT_TRUE(in_degrees && in_degrees->crs);
    EXPECT_THAT(in_degrees->notices, testing::IsEmpty());
}

TEST(CrsNotice, OfAWholeBodyInDegreesWithAProjectionOffersDegrees)
{
    RasterInfo grid = gridAt(-180, 90, 0.25, 1440, 720);
    grid.crs = *Crs::fromText("IAU_2015:49910");
    grid.body = grid.crs->body();
    const auto info = withOverrides(grid, {});
    ASSERT_TRUE(info && info->crs_suggestion);
    EXPECT_TRUE(info->crs) << "as the file says";
    EXPECT_EQ(info->crs_suggestion->choices, (std::vector<CrsChoice>{{"Mars", "IAU_2015:49902"}}));
    EXPECT_THAT(info->notices, testing::ElementsAre(noticeOf(*info->crs_suggestion)));
    EXPECT_THAT(info->notices[0], HasSubstr("does not fit the grid, which looks like longitude"));
    EXPECT_THAT(optionNoticeOf(*info->crs_suggestion), HasSubstr("with --crs IAU_2015:49902"));
    RasterOverrides overrides;
    overrides.crs = info->crs_suggestion->choices[0].crs;
    const auto placed = withOverrides(grid, overrides);
    ASSERT_TRUE(placed) << placed.error().message;
    EXPECT_THAT(placed->notices, testing::IsEmpty());
}

TEST(CrsOverride, IsAcceptedWithAGeotransformOfItsUnit)
{
    RasterInfo in_degrees = gridAt(0, 90, 0.25, 1440, 720);
    RasterOverrides overrides;
    overrides.crs = "EPSG:32610";
    overrides.transform = GeoTransform::Terms{5e5, 30, 0, 4e6, 0, -30};
    EXPECT_TRUE(withOverrides(in_degrees, overrides));
    // And the reverse: the geotransform is wrong.
    in_degrees.crs = *Crs::fromText("EPSG:4326");
    overrides.crs.reset();
    const auto refused = withOverrides(in_degrees, overrides);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refusedField(refused.error()), OverrideField::Transform) << refused.error().message;
}

} // namespace
} // namespace marsview
