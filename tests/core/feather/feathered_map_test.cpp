#include "core/feather/feathered_map.h"
#include "tests/support/map_maker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace marsview {
namespace {

using test::MapMaker;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kCells = 6;

BodyTerrain onBody(const std::shared_ptr<const Map>& map)
{
    JobMonitor monitor;
    return {map, BodyGrid::make(map->georeference(), monitor).value()};
}

std::shared_ptr<const Map> blended(const std::shared_ptr<const Map>& map,
                                   const std::vector<std::shared_ptr<const Map>>& below,
                                   std::size_t cells = kCells)
{
    std::vector<BodyTerrain> terrains;
    for (const auto& one : below) {
        terrains.push_back(onBody(one));
    }
    JobMonitor monitor;
    auto result = featheredMap(onBody(map), terrains, cells, monitor);
    EXPECT_TRUE(result) << (result ? "" : result.error().message);
    return *result;
}

MapMaker::Height level(double height_m)
{
    return [height_m](std::size_t, std::size_t) { return height_m; };
}

// A share of 3 t² - 2 t³ of its own height.
double mixed(double below_m, double own_m, double distance, double cells = kCells)
{
    const double t = std::min(distance / cells, 1.0);
    return below_m + (own_m - below_m) * (3.0 * t * t - 2.0 * t * t * t);
}

double toBorder(std::size_t column, std::size_t row, const Map& map)
{
    const Heightfield& heightfield = map.heightfield();
    return static_cast<double>(
        std::min({column, row, heightfield.columns() - 1 - column, heightfield.rows() - 1 - row}));
}

const MapMaker::Place kWhole{72, 36, {0, 5, 0, 90, 0, -5}, "IAU_2015:49900"};

// Its elevations are 40 m for each degree of longitude east and 25 m for each of latitude; between
// samples, too.
constexpr double kPerLongitudeM = 40.0;
constexpr double kPerLatitudeM = 25.0;
std::shared_ptr<const Map> tiltedPart(MapMaker& maker)
{
    return maker.make({60, 60, {100, 1, 0, 30, 0, -1}, "IAU_2015:49900"},
                      [](std::size_t column, std::size_t row) {
                          return kPerLongitudeM * (100.5 + static_cast<double>(column)) +
                                 kPerLatitudeM * (29.5 - static_cast<double>(row));
                      });
}

TEST(FeatheredMap, GoesFromThePlaneBelowToItsOwnOverSoManyCells)
{
    MapMaker maker;
    const auto below = tiltedPart(maker);
    const std::vector<MapMaker::Place> places{
        {40, 31, {121, 0.25, 0, 3, 0, -0.25}, "IAU_2015:49900"},
        {40, 31, {481, 0.25, 0, 3, 0, -0.25}, "IAU_2015:49900"}, // another turn
        {41, 33, {-2e5, 1e4, 0, 1.6e5, 0, -1e4}, "+proj=tmerc +lat_0=4 +lon_0=128 +R=3396190"},
        {41, 33, {-2e5, 1e4, 2e3, 1.6e5, 1e3, -1e4}, "+proj=laea +lat_0=2 +lon_0=126 +R=3396190"}};
    for (const MapMaker::Place& place : places) {
        const auto own = [](std::size_t column, std::size_t row) {
            return 7000.0 + 90.0 * static_cast<double>(column) - 70.0 * static_cast<double>(row);
        };
        const auto map = maker.make(place, own);
        const auto result = blended(map, {below});
        ASSERT_NE(result, map);
        EXPECT_EQ(result->georeference().columns(), place.columns);
        for (std::size_t row = 0; row < place.rows; ++row) {
            for (std::size_t column = 0; column < place.columns; ++column) {
                const auto at = map->georeference().toGeographic(
                    {static_cast<double>(column), static_cast<double>(row)});
                ASSERT_TRUE(at);
                const double longitude_deg = std::remainder(at->longitude.degrees() - 130, 360.0);
                const double below_m =
                    kPerLongitudeM * (130 + longitude_deg) + kPerLatitudeM * at->latitude.degrees();
                const double distance = toBorder(column, row, *map);
                const double height_m = result->heightfield().sample(column, row);
                if (distance >= kCells) {
                    ASSERT_EQ(height_m, own(column, row));
                } else {
                    ASSERT_NEAR(height_m, mixed(below_m, own(column, row), distance), 1e-3)
                        << place.srs << ' ' << column << ' ' << row;
                }
            }
        }
    }
}

// The same for the nearest sample that is a corner of a triangle with a void.
TEST(FeatheredMap, VoidsAreEndsToo)
{
    MapMaker maker;
    const auto below = maker.make(kWhole, level(-500.0));
    const MapMaker::Place place{60, 47, {10, 0.1, 0, 5, 0, -0.1}, "IAU_2015:49900"};
    const std::set<std::pair<long, long>> voids{{30, 20}, {31, 20}, {31, 21}, {14, 30},
                                                {45, 9},  {46, 10}, {59, 25}};
    const auto own = [&](std::size_t column, std::size_t row) {
        return voids.count({static_cast<long>(column), static_cast<long>(row)}) != 0
                   ? kNaN
                   : 300.0 + static_cast<double>((7 * column + 11 * row) % 13);
    };
    const auto map = maker.make(place, own);
    const auto result = blended(map, {below});
    const long last_column = 59;
    const long last_row = 46;
    const auto is_end = [&](long column, long row) {
        if (column == 0 || row == 0 || column == last_column || row == last_row) {
            return true;
        }
        // The triangles of a sample: the diagonal of a cell leads down to the right.
        return voids.count({column + 1, row}) != 0 || voids.count({column - 1, row}) != 0 ||
               voids.count({column, row + 1}) != 0 || voids.count({column, row - 1}) != 0 ||
               voids.count({column + 1, row + 1}) != 0 || voids.count({column - 1, row - 1}) != 0;
    };
    for (long row = 0; row <= last_row; ++row) {
        for (long column = 0; column <= last_column; ++column) {
            const auto c = static_cast<std::size_t>(column);
            const auto r = static_cast<std::size_t>(row);
            const double height_m = result->heightfield().sample(c, r);
            if (voids.count({column, row}) != 0) {
                ASSERT_TRUE(std::isnan(height_m));
                continue;
            }
            double nearest = 1e9;
            for (long i = 0; i <= last_row; ++i) {
                for (long k = 0; k <= last_column; ++k) {
                    if (voids.count({k, i}) == 0 && is_end(k, i)) {
                        nearest = std::min(nearest, std::hypot(static_cast<double>(k - column),
                                                               static_cast<double>(i - row)));
                    }
                }
            }
            ASSERT_NEAR(height_m, mixed(-500.0, own(c, r), nearest), 1e-3) << c << ' ' << r;
        }
    }
}

// Int16 samples with a scale: those that stay have the same heights to the bit.
TEST(FeatheredMap, KeepsTheHeightsOfOtherSamplesToTheBit)
{
    MapMaker maker;
    test::TempFolder folder;
    std::vector<std::int16_t> samples;
    for (int i = 0; i < 40 * 30; ++i) {
        samples.push_back(static_cast<std::int16_t>(i == 620 ? -9999 : (i * 7919) % 20011 - 9000));
    }
    test::RasterRecipe recipe = test::recipeFor(40, samples);
    recipe.transform = {20, 0.1, 0, 5, 0, -0.1};
    recipe.srs = "IAU_2015:49900";
    recipe.band_xml = "<NoDataValue>-9999</NoDataValue><Scale>0.3</Scale><Offset>11.7</Offset>";
    const auto map = test::loadedMap(writeVrt(folder, "scaled", recipe));
    const auto result = blended(map, {maker.make(kWhole, level(70.0))}, 3);
    EXPECT_EQ(result->heightfield().samples().type(), SampleType::Float32);
    std::size_t kept = 0;
    for (std::size_t row = 0; row < 30; ++row) {
        for (std::size_t column = 0; column < 40; ++column) {
            const double before_m = map->heightfield().sample(column, row);
            const double now_m = result->heightfield().sample(column, row);
            if (toBorder(column, row, *map) == 0.0) {
                EXPECT_NEAR(now_m, 70.0, 1e-3);
            } else if (toBorder(column, row, *map) >= 3.0 && now_m == before_m) {
                ++kept;
            }
        }
    }
    EXPECT_GT(kept, 34U * 24U - 50U); // all but those around the void
    // The analysis is that of the new heights.
    const MinMaxPyramid& bounds = result->analysis()->bounds;
    const auto whole = bounds.bounds(bounds.levelCount() - 1, 0, 0);
    EXPECT_LE(static_cast<double>(whole.minimum_m), result->heightfield().range()->minimum_m);
    EXPECT_GE(static_cast<double>(whole.maximum_m), result->heightfield().range()->maximum_m);
}

TEST(FeatheredMap, AMapAroundTheBodyEndsNeitherAtItsSeamNorAtPolesThatItReaches)
{
    MapMaker maker;
    const auto below = maker.make(kWhole, level(-1000.0));
    const auto own = [](std::size_t column, std::size_t row) {
        return static_cast<double>(column % 3) + static_cast<double>(row % 5);
    };
    // From pole to pole, with samples at half a cell from them, and with samples at the poles and a
    // column that repeats the first one.
    const auto whole = maker.make({90, 45, {0, 4, 0, 90, 0, -4}, "IAU_2015:49900"}, own);
    EXPECT_EQ(blended(whole, {below}), whole);
    const auto repeated =
        maker.make({73, 37, {-2.5, 5, 0, 92.5, 0, -5}, "IAU_2015:49900"}, level(3.0));
    EXPECT_EQ(blended(repeated, {below}), repeated);
    const MapMaker::Place belt{90, 30, {0, 4, 0, 60, 0, -4}, "IAU_2015:49900"};
    const auto map = maker.make(belt, own);
    const auto result = blended(map, {below});
    const auto hole = [&own](std::size_t column, std::size_t row) {
        return column == 89 && row == 15 ? kNaN : own(column, row);
    };
    const auto with_hole = blended(maker.make(belt, hole), {below});
    for (std::size_t row = 0; row < belt.rows; ++row) {
        const double distance = static_cast<double>(std::min(row, belt.rows - 1 - row));
        for (std::size_t column = 0; column < belt.columns; ++column) {
            ASSERT_NEAR(result->heightfield().sample(column, row),
                        mixed(-1000.0, own(column, row), distance), 1e-3)
                << column << ' ' << row;
        }
    }
    // A void in the last column is next to the first one.
    EXPECT_NEAR(with_hole->heightfield().sample(0, 15), -1000.0, 1e-3);
    EXPECT_NEAR(with_hole->heightfield().sample(2, 15), mixed(-1000.0, own(2, 15), 2.0), 1e-3);
}

TEST(FeatheredMap, ReachesOverAPole)
{
    MapMaker maker;
    const auto below = maker.make(
        {72, 36, {0, 5, 0, 90, 0, -5}, "IAU_2015:49900"},
        [](std::size_t, std::size_t row) { return 90.0 - 2.5 - 5.0 * static_cast<double>(row); });
    // 21 × 21 samples of 100 km around the pole.
    const MapMaker::Place polar{21, 21, {-1.05e6, 1e5, 0, 1.05e6, 0, -1e5}, "IAU_2015:49930"};
    const auto map = maker.make(polar, level(4000.0));
    const auto result = blended(map, {below}, 30); // all of it
    for (std::size_t row = 0; row < 21; ++row) {
        for (std::size_t column = 0; column < 21; ++column) {
            const double distance = toBorder(column, row, *map);
            const auto place = map->georeference().toGeographic(
                {static_cast<double>(column), static_cast<double>(row)});
            // The triangles at the pole are level around it: 87.5 m.
            const double below_m = std::min(place->latitude.degrees(), 87.5);
            ASSERT_NEAR(result->heightfield().sample(column, row),
                        mixed(below_m, 4000.0, distance, 30.0), 1e-3)
                << column << ' ' << row;
        }
    }
}

// The lower map ends below the upper one: no step of the blended map is as high as the one that
// would be there.
TEST(FeatheredMap, KeepsItsHeightsWhereNothingLiesBelowAndFadesTowardsThere)
{
    MapMaker maker;
    const auto below = maker.make({20, 40, {0, 1, 0, 20, 0, -1}, "IAU_2015:49900"}, level(0.0));
    const MapMaker::Place place{100, 60, {10, 0.2, 0, 6, 0, -0.2}, "IAU_2015:49900"};
    const auto map = maker.make(place, level(1000.0)); // one half is over the other map
    const auto result = blended(map, {below}, 20);
    double step_max_m = 0.0;
    for (std::size_t row = 0; row < place.rows; ++row) {
        for (std::size_t column = 0; column < place.columns; ++column) {
            const double height_m = result->heightfield().sample(column, row);
            const double longitude_deg = 10.1 + 0.2 * static_cast<double>(column);
            if (longitude_deg > 19.5) {
                ASSERT_EQ(height_m, 1000.0);
            }
            if (column > 0) {
                step_max_m = std::max(
                    step_max_m, std::abs(height_m - result->heightfield().sample(column - 1, row)));
            }
        }
    }
    EXPECT_NEAR(result->heightfield().sample(0, 0), 0.0, 1e-3);
    EXPECT_LE(step_max_m, 1000.0 * 1.5 / 20.0 + 1.0); // the steepest part of the curve
    EXPECT_EQ(blended(map, {}), map);
    EXPECT_EQ(blended(map, {below}, 0), map);
    const auto far_away =
        maker.make({20, 40, {200, 1, 0, 20, 0, -1}, "IAU_2015:49900"}, level(0.0));
    EXPECT_EQ(blended(map, {far_away}), map);
}

TEST(FeatheredMap, TheUppermostMapBelowCountsAsItIsShown)
{
    MapMaker maker;
    const auto lowest = maker.make(kWhole, level(-300.0));
    const auto middle =
        maker.make({60, 60, {20, 0.5, 0, 15, 0, -0.5}, "IAU_2015:49900"}, level(900.0));
    const auto top =
        maker.make({40, 40, {15, 0.5, 0, 10, 0, -0.5}, "IAU_2015:49900"}, level(2000.0));
    JobMonitor monitor;
    const BodyTerrain base = onBody(lowest);
    const auto middle_shown = featheredMap(onBody(middle), std::vector{base}, 8, monitor).value();
    const BodyTerrain shown(middle, onBody(middle).grid(), middle_shown);
    EXPECT_EQ(shown.map(), middle);
    EXPECT_EQ(shown.shown(), middle_shown);
    const auto result = featheredMap(onBody(top), std::vector{shown, base}, 4, monitor).value();
    const auto place = [](double longitude_deg, double latitude_deg) {
        return GeographicPoint{.longitude = Angle::degrees(longitude_deg),
                               .latitude = Angle::degrees(latitude_deg)};
    };
    for (const std::size_t row : {0U, 7U, 20U}) {
        // At the western border, outside the middle map; at the eastern one, over it.
        EXPECT_NEAR(result->heightfield().sample(0, row), -300.0, 1e-3);
        const GeographicPoint at = place(34.75, 9.75 - 0.5 * static_cast<double>(row));
        EXPECT_NEAR(result->heightfield().sample(39, row), shown.height(at), 1e-3);
    }
    // Blended and as it was opened.
    const GeographicPoint inside = place(21.25, 0.0);
    const auto grid = shown.gridAt(inside);
    EXPECT_NEAR(shown.heightOnGrid(*grid), mixed(-300.0, 900.0, 2.0, 8.0), 1e-3);
    EXPECT_EQ(shown.elevationOnGrid(*grid), 900.0);
}

TEST(FeatheredMap, BlendingCanBeCanceled)
{
    MapMaker maker;
    const auto below = maker.make(kWhole, level(0.0));
    const auto map = maker.make({60, 40, {20, 0.1, 0, 5, 0, -0.1}, "IAU_2015:49900"}, level(1.0));
    JobMonitor monitor;
    monitor.cancel();
    const auto canceled = featheredMap(onBody(map), std::vector{onBody(below)}, 5, monitor);
    ASSERT_FALSE(canceled);
    EXPECT_EQ(canceled.error().code, ErrorCode::Canceled);
}

} // namespace
} // namespace marsview
