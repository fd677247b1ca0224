#include "core/body/body_positions.h"
#include "tests/support/random.h"

#include <GeographicLib/Geocentric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

namespace marsview {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct PositionCase {
    const char* name;
    const char* crs;
    std::size_t columns;
    std::size_t rows;
    GeoTransform::Terms terms;
    friend std::ostream& operator<<(std::ostream& out, const PositionCase& c)
    {
        return out << c.name;
    }
};

std::vector<PositionCase> positionCases()
{
    const double c30 = 30.0 * std::cos(0.5);
    const double s30 = 30.0 * std::sin(0.5);
    constexpr const char* kMarsSinusoidal = "+proj=sinu +lon_0=137 +R=3396190 +units=m";
    constexpr const char* kMoonStereographic =
        "+proj=stere +lat_0=-90 +lon_0=0 +R=1737400 +units=m";
    constexpr const char* kMarsEllipsoid =
        "+proj=lcc +lat_1=-40 +lat_2=-30 +lon_0=70 +a=3396190 +b=3376200 +units=m";
    return {
        {"Earth", "EPSG:4326", 360, 170, {-180, 1, 0, 85, 0, -1}},
        {"EarthRotated", "EPSG:4326", 300, 200, {10, 0.1, 0.03, 40, 0.02, -0.1}},
        {"MarsPlanetocentric", "IAU_2015:49900", 720, 360, {0, 0.5, 0, 90, 0, -0.5}},
        {"MarsPlanetographic", "IAU_2015:49901", 360, 180, {0, 1, 0, 90, 0, -1}},
        {"Utm", "EPSG:32610", 327, 468, {557805, 30, 0, 5121975, 0, -30}},
        {"UtmSouthUp", "EPSG:32733", 200, 300, {300000, 30, 0, 6e6, 0, 30}},
        {"UtmRotated", "EPSG:32611", 700, 643, {390045, c30, s30, 3797505, s30, -c30}},
        {"UtmCoarse", "EPSG:32611", 60, 80, {200000, 5000, 0, 3900000, 0, -5000}},
        {"UtmOneMeter", "EPSG:32611", 500, 400, {390045, 1, 0, 3797505, 0, -1}},
        {"PolarNorth", "EPSG:3995", 500, 500, {-2e6, 8000, 0, 2e6, 0, -8000}},
        {"MoonSouthPole", kMoonStereographic, 401, 401, {-20050, 100, 0, 20050, 0, -100}},
        {"MarsSinusoidal", kMarsSinusoidal, 300, 300, {-150000, 1000, 0, 1200000, 0, -1000}},
        {"MarsLambert", kMarsEllipsoid, 300, 200, {-30000, 200, 0, 20000, 0, -200}},
        {"Mercator", "EPSG:3395", 300, 200, {0, 10000, 0, 8e6, 0, -10000}},
    };
}

class Placed : public testing::TestWithParam<PositionCase> {
protected:
    Georeference georeference() const
    {
        const PositionCase& c = GetParam();
        return {c.columns, c.rows, *GeoTransform::fromTerms(c.terms), *Crs::fromText(c.crs)};
    }
};

// GeographicLib's CartConvert computes the position from longitude, latitude and height.
TEST_P(Placed, SamplesLieWhereCartConvertPutsThem)
{
    const Georeference georeference = this->georeference();
    JobMonitor monitor;
    const auto positions = BodyPositions::make(georeference, monitor);
    ASSERT_TRUE(positions) << positions.error().message;
    const Ellipsoid& body = positions->ellipsoid();
    const GeographicLib::Geocentric frame(body.equatorial_m, body.flattening());
    const double cell_m =
        std::min(georeference.pixelWidthMeters(), georeference.pixelHeightMeters());
    const double axes = body.polar_m / body.equatorial_m;
    test::Random random(11);
    double worst_m = 0.0;
    for (int i = 0; i < 20'000; ++i) {
        const auto column = static_cast<std::size_t>(
            random.uniform(0.0, static_cast<double>(positions->columns()) - 1e-9));
        const auto row = static_cast<std::size_t>(
            random.uniform(0.0, static_cast<double>(positions->rows()) - 1e-9));
        const double height_m = random.uniform(-9000.0, 22000.0);
        const auto place = georeference.toGeographic(GridPoint{
            static_cast<double>(column), static_cast<double>(row + positions->firstRow())});
        ASSERT_TRUE(place);
        const double graphic_deg =
            std::atan(std::tan(place->latitude.radians()) / (axes * axes)) / kDegree;
        Vec3 expected;
        frame.Forward(graphic_deg, place->longitude.degrees(), height_m, expected.x, expected.y,
                      expected.z);
        worst_m = std::max(worst_m, length(positions->at(column, row, height_m) - expected));
    }
    RecordProperty("worst_m", std::to_string(worst_m));
    EXPECT_LT(worst_m, std::min(1e-3, 1e-6 * cell_m));
}

// Layers in CRSs with other radii lie together: only longitude, planetocentric latitude and height
// count.
TEST_P(Placed, OnTheEllipsoidOfASceneSamplesKeepTheirPlaces)
{
    const Georeference georeference = this->georeference();
    constexpr Ellipsoid kScene{.equatorial_m = 3.4e6, .polar_m = 3.37e6};
    JobMonitor monitor;
    const auto positions = BodyPositions::make(georeference, monitor, kScene);
    ASSERT_TRUE(positions) << positions.error().message;
    EXPECT_EQ(positions->ellipsoid(), kScene);
    const GeographicLib::Geocentric frame(kScene.equatorial_m, kScene.flattening());
    const double cell_m =
        std::min(georeference.pixelWidthMeters(), georeference.pixelHeightMeters());
    test::Random random(12);
    for (int i = 0; i < 500; ++i) {
        const auto column = static_cast<std::size_t>(
            random.uniform(0.0, 0.999999 * static_cast<double>(positions->columns())));
        const auto row = static_cast<std::size_t>(
            random.uniform(0.0, 0.999999 * static_cast<double>(positions->rows())));
        const double height_m = random.uniform(-8000.0, 21000.0);
        const auto place = georeference.toGeographic(GridPoint{
            static_cast<double>(column), static_cast<double>(row + positions->firstRow())});
        ASSERT_TRUE(place);
        Vec3 truth;
        frame.Forward(kScene.planetographic(place->latitude).degrees(), place->longitude.degrees(),
                      height_m, truth.x, truth.y, truth.z);
        EXPECT_LT(length(positions->at(column, row, height_m) - truth),
                  std::min(1e-3, 1e-6 * cell_m));
    }
}

INSTANTIATE_TEST_SUITE_P(BodyPositions,
                         Placed,
                         testing::ValuesIn(positionCases()),
                         [](const auto& tested) { return std::string(tested.param.name); });

Result<BodyPositions> positionsOf(const char* crs,
                                  std::size_t columns,
                                  std::size_t rows,
                                  const GeoTransform::Terms& terms)
{
    JobMonitor monitor;
    return BodyPositions::make(
        {columns, rows, *GeoTransform::fromTerms(terms), *Crs::fromText(crs)}, monitor);
}

TEST(BodyPositions, ColumnsAroundTheBodyMeetAndRowsNextToAPoleCloseIt)
{
    const auto whole = positionsOf("IAU_2015:49900", 720, 360, {0, 0.5, 0, 90, 0, -0.5});
    ASSERT_TRUE(whole);
    EXPECT_TRUE(whole->wraps());
    EXPECT_TRUE(whole->closesAtFirstRow());
    EXPECT_TRUE(whole->closesAtLastRow());
    const auto belt = positionsOf("IAU_2015:49900", 720, 120, {0, 0.5, 0, 30, 0, -0.5});
    ASSERT_TRUE(belt);
    EXPECT_TRUE(belt->wraps());
    EXPECT_FALSE(belt->closesAtFirstRow());
    EXPECT_FALSE(belt->closesAtLastRow());
    const auto part = positionsOf("IAU_2015:49900", 719, 360, {0, 0.5, 0, 90, 0, -0.5});
    ASSERT_TRUE(part);
    EXPECT_FALSE(part->closesAtFirstRow());
}

TEST(BodyPositions, RepeatedColumnsAndRowsAtThePolesAreLeftOut)
{
    const auto registered = positionsOf("IAU_2015:49900", 361, 181, {-0.5, 1, 0, 90.5, 0, -1});
    ASSERT_TRUE(registered) << registered.error().message;
    EXPECT_EQ(registered->columns(), 360U);
    EXPECT_EQ(registered->rows(), 179U);
    EXPECT_EQ(registered->firstRow(), 1U);
    EXPECT_TRUE(registered->wraps());
    EXPECT_TRUE(registered->closesAtFirstRow());
    EXPECT_TRUE(registered->closesAtLastRow());
}

TEST(BodyPositions, PlacementsThatFitNoBodyAreRefusedWithTheReason)
{
    JobMonitor monitor;
    const auto local = BodyPositions::make({10, 10, GeoTransform(), std::nullopt}, monitor);
    ASSERT_FALSE(local);
    EXPECT_NE(local.error().message.find("no CRS"), std::string::npos);
    const auto beyond = positionsOf("IAU_2015:49900", 100, 100, {0, 1, 0, 120, 0, -1});
    ASSERT_FALSE(beyond);
    EXPECT_NE(beyond.error().message.find("beyond a pole"), std::string::npos);
    const auto twice = positionsOf("IAU_2015:49900", 500, 100, {0, 1, 0, 50, 0, -1});
    ASSERT_FALSE(twice);
    EXPECT_NE(twice.error().message.find("360°"), std::string::npos);
}

} // namespace
} // namespace marsview
