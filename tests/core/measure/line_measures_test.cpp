#include "core/measure/line_measures.h"
#include "core/terrain/seam.h"
#include "tests/core/measure/measured_lines.h"
#include "tests/core/measure/measured_map.h"
#include "tests/support/map_maker.h"
#include "tests/support/nan.h"
#include "tests/support/random.h"
#include "tests/support/shared_data.h"

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/GeodesicLine.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

namespace marsview::test {
namespace {

// Compares a profile with single elevations every 1/16 of a cell along a geodesic of GeographicLib.
// Returns the largest difference; counts the points where only one of both is void.
struct Comparison {
    double worst_m = 0.0;
    int compared = 0;
    int voids = 0;
    int mismatched_voids = 0;
};

Comparison compare(const Map& map, const GroundPosition& a, const GroundPosition& b)
{
    MeasuredTerrain terrain = terrainOf(map);
    const Profile profile = profileOf(terrain, {a, b});
    const Ellipsoid& ellipsoid = *map.georeference().crs()->ellipsoid();
    const GeographicLib::Geodesic geodesic(ellipsoid.equatorial_m, ellipsoid.flattening());
    const GeographicLib::GeodesicLine line = geodesic.InverseLine(a.y, a.x, b.y, b.x);
    const double cell_m =
        std::min(map.georeference().pixelWidthMeters(), map.georeference().pixelHeightMeters());
    Comparison result;
    const auto count = static_cast<int>(std::min(line.Distance() / cell_m * 16.0, 40'000.0));
    for (int i = 0; i <= count; ++i) {
        const double s = line.Distance() * i / count;
        GroundPosition here;
        line.Position(s, here.y, here.x);
        const auto grid = terrain.toGrid(here);
        if (grid && terrain.capBeyond(grid->row)) {
            continue; // beyond the rows: cap_path_test
        }
        const double truth_m =
            map.height({Angle::degrees(here.x), ellipsoid.planetocentric(Angle::degrees(here.y))});
        const double found_m = interpolated(profile, s);
        ++result.compared;
        if (std::isnan(truth_m) != std::isnan(found_m)) {
            ++result.mismatched_voids;
        } else if (std::isnan(truth_m)) {
            ++result.voids;
        } else {
            result.worst_m = std::max(result.worst_m, std::abs(truth_m - found_m));
        }
    }
    EXPECT_NEAR(profile.points.back().distance_m, line.Distance(), 1e-6);
    return result;
}

std::shared_ptr<const Map> rough(MapMaker& maker, const MapMaker::Place& place, double void_share)
{
    Random random(7);
    std::vector<double> heights;
    for (std::size_t i = 0; i < place.columns * place.rows; ++i) {
        heights.push_back(random.chance(void_share) ? kNan : random.uniform(-500.0, 500.0));
    }
    return maker.make(place,
                      [&](std::size_t c, std::size_t r) { return heights[r * place.columns + c]; });
}

const char* kMarsPolar = "+proj=stere +lat_0=90 +lon_0=20 +a=3396190 +b=3376200 +units=m";
const char* kMarsConic =
    "+proj=lcc +lat_1=30 +lat_2=50 +lat_0=40 +lon_0=100 +a=3396190 +b=3376200 +units=m";

} // namespace

TEST(Profile, IsTheTerrainEverySixteenthOfACell)
{
    Random random;
    const auto mars = loadedMap(bundledMars());
    double worst_m = 0.0;
    int compared = 0;
    for (int i = 0; i < 40; ++i) {
        const GroundPosition a{random.uniform(-180.0, 540.0), random.uniform(-85.0, 85.0)};
        const GroundPosition b{random.uniform(-180.0, 540.0), random.uniform(-85.0, 85.0)};
        const Comparison result = compare(*mars, a, b);
        worst_m = std::max(worst_m, result.worst_m);
        compared += result.compared;
        // Near a pole beyond the last row, a void may begin between two of the positions.
        EXPECT_LE(result.mismatched_voids, 1);
    }
    std::printf("%d elevations, largest difference %.2g m\n", compared, worst_m);
    EXPECT_LT(worst_m, 1e-3);
}

TEST(Profile, IsTheTerrainInProjectionsAndAtVoids)
{
    Random random;
    MapMaker maker;
    const std::vector<MapMaker::Place> places{
        {.columns = 80,
         .rows = 60,
         .transform = {500000, 30, 0, 4000000, 0, -30},
         .srs = "EPSG:32610"},
        {.columns = 90,
         .rows = 90,
         .transform = {-450000, 10000, 0, 450000, 0, -10000},
         .srs = kMarsPolar},
        {.columns = 70,
         .rows = 50,
         .transform = {-70000, 2000, 300, 40000, -300, -1900},
         .srs = kMarsConic},
        {.columns = 72, .rows = 36, .transform = {-180, 5, 0, 90, 0, -5}, .srs = "IAU_2015:49900"},
        {.columns = 60,
         .rows = 60,
         .transform = {10.0, 1e-3, 0, 60.0, 0, -1e-3},
         .srs = "EPSG:4326"},
    };
    for (const MapMaker::Place& place : places) {
        for (const double void_share : {0.0, 0.05}) {
            const auto map = rough(maker, place, void_share);
            SCOPED_TRACE(place.srs);
            const MeasuredTerrain terrain = terrainOf(*map);
            double worst_m = 0.0;
            int voids = 0;
            int mismatched = 0;
            int compared = 0;
            for (int i = 0; i < 30; ++i) {
                const auto anywhere = [&] {
                    return *terrain.fromGrid(
                        {random.uniform(-2.0, static_cast<double>(place.columns) + 1.0),
                         random.uniform(1.0, static_cast<double>(place.rows) - 2.0)});
                };
                const Comparison result = compare(*map, anywhere(), anywhere());
                worst_m = std::max(worst_m, result.worst_m);
                voids += result.voids;
                mismatched += result.mismatched_voids;
                compared += result.compared;
            }
            std::printf("%s: %d elevations, %d void, largest difference %.2g m\n",
                        place.srs.c_str(), compared, voids, worst_m);
            EXPECT_LT(worst_m, 1e-3);
            EXPECT_LE(mismatched, compared / 2000); // a void begins between two positions
            if (void_share > 0.0) {
                EXPECT_GT(voids, 100);
            }
        }
    }
}

TEST(Profile, FollowsRowsAndColumnsOfSamples)
{
    MapMaker maker;
    // A void column next to column 4: a line along that column of samples has no gap.
    const auto map = maker.make({.columns = 10,
                                 .rows = 10,
                                 .transform = {100.0, 1.0, 0.0, 5.5, 0.0, -1.0},
                                 .srs = "IAU_2015:30100"},
                                [](std::size_t c, std::size_t r) {
                                    return c == 5 ? kNan : static_cast<double>(10 * c + r);
                                });
    MeasuredTerrain terrain = terrainOf(*map);
    const Profile south = profileOf(terrain, {{104.5, 4.0}, {104.5, -4.0}});
    ASSERT_EQ(south.points.size(), 9U);
    for (std::size_t i = 0; i < south.points.size(); ++i) {
        EXPECT_EQ(south.points[i].elevation_m, 41.0 + static_cast<double>(i));
    }
    const Profile east = profileOf(terrain, {{101.5, 0.0}, {108.5, 0.0}});
    EXPECT_TRUE(std::isnan(interpolated(east, 0.5 * east.points.back().distance_m)));
    EXPECT_EQ(east.points.front().elevation_m, 15.0);
    EXPECT_EQ(east.points.back().elevation_m, 85.0);
    // Each end of the gap is the last sample before it. Elevations at samples end in 5.
    std::vector<double> known;
    for (const ProfilePoint& point : east.points) {
        if (std::isfinite(point.elevation_m) && std::fmod(point.elevation_m, 10.0) == 5.0) {
            known.push_back(point.elevation_m);
        }
    }
    EXPECT_EQ(known, (std::vector<double>{15.0, 25.0, 35.0, 45.0, 65.0, 75.0, 85.0}));
}

TEST(Profile, CrossesTheSeamOfAMapAroundTheBody)
{
    const auto mars = loadedMap(bundledMars());
    MeasuredTerrain terrain = terrainOf(*mars);
    const Profile across = profileOf(terrain, {{350.0, 5.0}, {10.0, -7.0}});
    const Profile shifted = profileOf(terrain, {{-10.0, 5.0}, {370.0, -7.0}});
    ASSERT_EQ(across.points.size(), shifted.points.size());
    for (std::size_t i = 0; i < across.points.size(); ++i) {
        ASSERT_TRUE(std::isfinite(across.points[i].elevation_m));
        ASSERT_NEAR(across.points[i].elevation_m, shifted.points[i].elevation_m, 1e-6);
        ASSERT_NEAR(across.points[i].distance_m, shifted.points[i].distance_m, 1e-6);
    }
}

TEST(Profile, CountsLongitudesInTheTurnOfTheMap)
{
    const auto mars = loadedMap(bundledMars()); // 0° to 360°
    MeasuredTerrain terrain = terrainOf(*mars);
    for (const double turn : {-720.0, 0.0, 360.0}) {
        const Profile profile = profileOf(terrain, {{350.0 + turn, 5.0}, {370.0 + turn, -7.0}});
        EXPECT_EQ(profile.points.front().position.x, 350.0);
        EXPECT_NEAR(profile.points.back().position.x, 10.0, 1e-9);
        for (const ProfilePoint& point : profile.points) {
            EXPECT_GE(point.position.x, 0.0);
            EXPECT_LE(point.position.x, 360.0);
        }
    }
}

TEST(Profile, CrossesASeamThatIsNotExactlyOneColumnWide)
{
    MapMaker maker;
    // 360 columns of 1.0004° are 0.144° more than a turn.
    for (const double step : {1.0004, 0.9998, 1.000000001}) {
        const auto map =
            maker.make({.columns = 360,
                        .rows = 40,
                        .transform = {0.0, step, 0.0, 20.0, 0.0, -1.0},
                        .srs = "IAU_2015:30100"},
                       [](std::size_t, std::size_t r) { return static_cast<double>(r); });
        MeasuredTerrain terrain = terrainOf(*map);
        const Profile profile = profileOf(terrain, {{350.0, 5.0}, {10.0, -7.0}});
        double low_m = 1e9;
        double high_m = -1e9;
        for (const ProfilePoint& point : profile.points) {
            // The terrain is its row, so it is the same all around.
            EXPECT_NEAR(point.elevation_m, 19.5 - point.position.y, 1e-3) << step;
            low_m = std::min(low_m, point.elevation_m);
            high_m = std::max(high_m, point.elevation_m);
        }
        EXPECT_NEAR(low_m, 14.5, 1e-3);
        EXPECT_NEAR(high_m, 26.5, 1e-3);
    }
}

TEST(Profile, TakesStepsOfTheLengthThatIsStated)
{
    const auto mars = loadedMap(bundledMars());
    MeasuredTerrain terrain = terrainOf(*mars);
    const std::vector<GroundPosition> way{{200.0, 5.0}, {203.0, 6.0}, {201.0, 8.0}};
    const Profile exact = profileOf(terrain, way);
    const Profile stepped = profileOf(terrain, way, 1000.0);
    for (std::size_t i = 0; i + 1 < stepped.points.size(); ++i) {
        EXPECT_EQ(stepped.points[i].distance_m, 1000.0 * static_cast<double>(i));
        EXPECT_NEAR(stepped.points[i].elevation_m,
                    interpolated(exact, stepped.points[i].distance_m), 1e-3);
    }
    EXPECT_EQ(stepped.points.back().distance_m, exact.points.back().distance_m);
    JobMonitor monitor;
    const auto refused = measureProfile(terrain, way, 1e-6, monitor);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::OutOfRange);
}

TEST(Profile, StopsWhenItIsCanceled)
{
    const auto mars = loadedMap(bundledMars());
    MeasuredTerrain terrain = terrainOf(*mars);
    JobMonitor monitor;
    monitor.cancel();
    const std::vector<GroundPosition> way{{0.0, 5.0}, {170.0, 6.0}};
    const auto profile = measureProfile(terrain, way, std::nullopt, monitor);
    ASSERT_FALSE(profile);
    EXPECT_EQ(profile.error().code, ErrorCode::Canceled);
}

TEST(Profile, OfACoarseLevelIsThatOfItsSamples)
{
    MapMaker maker;
    Random random;
    // Linear between every fourth sample, the last column and the last row included: the level that
    // has only those shows the same terrain. Around the body, so that there is a seam.
    std::vector<double> knots;
    for (int i = 0; i < 400; ++i) {
        knots.push_back(random.uniform(0.0, 1000.0));
    }
    const MapMaker::Place place{.columns = 72,
                                .rows = 36,
                                .transform = {0.0, 5.0, 0.0, 90.0, 0.0, -5.0},
                                .srs = "IAU_2015:49900"};
    const auto map = maker.make(place, [&](std::size_t c, std::size_t r) {
        return c % 4 == 0 || c == 71
                   ? (r % 4 == 0 || r == 35 ? knots[(r / 4 + (r == 35)) * 20 + c / 4 + (c == 71)]
                                            : 5000.0)
                   : 5000.0;
    });
    MeasuredTerrain fine = terrainOf(*map);
    MeasuredTerrain coarse = terrainOf(*map, 2);
    EXPECT_FALSE(fine.isApproximate());
    EXPECT_TRUE(coarse.isApproximate());
    const Profile profile = profileOf(coarse, {{-20.0, 40.0}, {30.0, -40.0}});
    EXPECT_TRUE(profile.is_approximate);
    for (const ProfilePoint& point : profile.points) {
        EXPECT_LE(point.elevation_m, 1000.0); // no other sample is used
    }
    for (const std::size_t column : {0U, 4U, 68U, 71U}) {
        for (const std::size_t row : {0U, 4U, 32U, 35U}) {
            const GroundPosition at =
                *coarse.fromGrid({static_cast<double>(column), static_cast<double>(row)});
            EXPECT_NEAR(coarse.elevation(at), fine.elevation(at), 1e-6) << column << " " << row;
        }
    }
    const std::vector<GroundPosition> way{{-20.0, 40.0}, {30.0, -40.0}};
    EXPECT_EQ(profileLevel(fine, way, 1e6), 0U);
    EXPECT_GE(profileLevel(fine, way, 10.0), 1U);
}

TEST(Profile, ReachesFarBeyondTheProjectionOfAMap)
{
    MapMaker maker;
    const auto level = [](std::size_t, std::size_t) { return 3.0; };
    for (const MapMaker::Place& place :
         {MapMaker::Place{.transform = {-1e5, 1e4, 0, 8e4, 0, -1e4}, .srs = kMarsPolar},
          MapMaker::Place{.transform = {-1e5, 1e4, 0, 8e4, 0, -1e4}, .srs = kMarsConic},
          MapMaker::Place{.srs = "EPSG:32610"},
          MapMaker::Place{.transform = {-1e5, 1e4, 0, 8e4, 0, -1e4},
          .srs = "+proj=sinu +R=1737400"},
          MapMaker::Place{.transform = {-1e5, 1e4, 0, 8e4, 0, -1e4},
          .srs = "+proj=ortho +R=1737400"},
          MapMaker::Place{.transform = {-1e5, 1e4, 0, 8e4, 0, -1e4},
          .srs = "+proj=gnom +lat_0=30 +R=1737400"},
          MapMaker::Place{.transform = {-1e5, 1e4, 0, 8e4, 0, -1e4},
          .srs = "+proj=merc +R=1737400"}}) {
        SCOPED_TRACE(place.srs);
        const auto map = maker.make(place, level);
        MeasuredTerrain terrain = terrainOf(*map);
        const GroundPosition here = *terrain.fromGrid({10.0, 7.0});
        for (const GroundPosition& there :
             {GroundPosition{0.0, 90.0}, GroundPosition{0.0, -90.0},
              GroundPosition{here.x + 180.0, -here.y}, GroundPosition{here.x + 180.0, here.y},
              GroundPosition{here.x + 90.0, 0.0}}) {
            const Distance distance = distanceOf(terrain, {here, there, here});
            EXPECT_GT(distance.surface_m, 100.0);
            EXPECT_NEAR(distance.surface_m + distance.void_m, distance.geodesic_m,
                        1e-6 * distance.geodesic_m);
        }
    }
}

TEST(Distance, OfSectionsAddsUpToTheWhole)
{
    Random random;
    const auto mars = loadedMap(bundledMars());
    MeasuredTerrain terrain = terrainOf(*mars);
    for (int i = 0; i < 20; ++i) {
        const GroundPosition a{random.uniform(0.0, 360.0), random.uniform(-70.0, 70.0)};
        const GroundPosition b{random.uniform(0.0, 360.0), random.uniform(-70.0, 70.0)};
        const GroundLine line = terrain.ground().line(a, b);
        std::vector<double> cuts_m{0.0, line.lengthM()};
        for (int k = 0; k < 5; ++k) {
            cuts_m.push_back(random.uniform(0.0, line.lengthM()));
        }
        std::sort(cuts_m.begin(), cuts_m.end());
        std::vector<GroundPosition> positions;
        for (const double cut_m : cuts_m) {
            positions.push_back(line.at(cut_m));
        }
        const Distance whole = distanceOf(terrain, {a, b});
        const Distance parts = distanceOf(terrain, positions);
        EXPECT_NEAR(parts.geodesic_m, whole.geodesic_m, 1e-9 * whole.geodesic_m);
        EXPECT_NEAR(parts.surface_m + parts.void_m, whole.surface_m + whole.void_m,
                    1e-9 * whole.geodesic_m);
        EXPECT_NEAR(parts.rise_m, whole.rise_m, 1e-6);
        ASSERT_EQ(parts.legs.size(), 6U);
        double sum_m = 0.0;
        for (const LegDistance& leg : parts.legs) {
            sum_m += leg.surface_m;
        }
        EXPECT_DOUBLE_EQ(sum_m, parts.surface_m);
    }
}

TEST(Distance, AlongAnInclinedPlaneIsLongerByItsSlope)
{
    MapMaker maker;
    // Without a CRS: a plane in meters that rises by 0.75 per meter to the east.
    const auto map = maker.make(
        {.columns = 50, .rows = 40, .transform = {1000.0, 2.0, 0.0, 3000.0, 0.0, -2.0}, .srs = ""},
        [](std::size_t c, std::size_t) { return 1.5 * static_cast<double>(c); });
    MeasuredTerrain terrain = terrainOf(*map);
    const Distance east = distanceOf(terrain, {{1011.0, 2950.0}, {1051.0, 2950.0}});
    EXPECT_DOUBLE_EQ(east.geodesic_m, 40.0);
    EXPECT_NEAR(east.surface_m, 50.0, 1e-9);
    EXPECT_NEAR(east.straight_m, 50.0, 1e-9);
    EXPECT_NEAR(east.rise_m, 30.0, 1e-9);
    EXPECT_EQ(east.legs.front().azimuth_deg, 90.0);
    const Distance north = distanceOf(terrain, {{1011.0, 2950.0}, {1011.0, 2980.0}});
    EXPECT_NEAR(north.surface_m, 30.0, 1e-9);
    const Distance out = distanceOf(terrain, {{1091.0, 2950.0}, {1111.0, 2950.0}});
    EXPECT_NEAR(out.void_m, 12.0, 1e-9); // the last sample is at x = 1099
    EXPECT_NEAR(out.surface_m, 10.0, 1e-9);
    EXPECT_TRUE(std::isnan(out.rise_m));
}

TEST(Distance, RefusesWhatIsNotALine)
{
    const auto mars = loadedMap(bundledMars());
    MeasuredTerrain terrain = terrainOf(*mars);
    JobMonitor monitor;
    const auto message = [&](const std::vector<GroundPosition>& positions) {
        const auto distance = measureDistance(terrain, positions, monitor);
        return distance ? std::string() : distance.error().message;
    };
    EXPECT_EQ(message({{1.0, 2.0}}), "a distance needs at least 2 positions, but there is 1");
    EXPECT_EQ(message({{1.0, 2.0}, {3.0, 91.0}}),
              "position 2 has latitude 91, which is outside -90 to 90 degrees; write longitude "
              "before latitude");
    EXPECT_EQ(message({{kNan, 2.0}, {3.0, 1.0}}),
              "position 1 is nan, 2; two finite numbers are required");
    EXPECT_EQ(message({{1.0, 2.0}, {1.0, 2.0}}), ""); // 0 m
}

} // namespace marsview::test
