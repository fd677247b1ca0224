#include "core/measure/attitude.h"
#include "tests/core/measure/measured_map.h"
#include "tests/support/map_maker.h"
#include "tests/support/random.h"
#include "tests/support/shared_data.h"

#include <GeographicLib/LocalCartesian.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

// The upward unit normal of a plane: east, north, up.
Vec3 normalOf(double strike_deg, double dip_deg)
{
    const double direction = (strike_deg + 90.0) * kRadians;
    const double dip = dip_deg * kRadians;
    return {std::sin(dip) * std::sin(direction), std::sin(dip) * std::cos(direction),
            std::cos(dip)};
}

double gaussian(Random& random)
{
    return std::sqrt(-2.0 * std::log(1.0 - random.unit())) *
           std::cos(2.0 * std::numbers::pi * random.unit());
}

Vec3 fromTrend(const PoleAxis& axis)
{
    return {std::cos(axis.plunge_deg * kRadians) * std::sin(axis.trend_deg * kRadians),
            std::cos(axis.plunge_deg * kRadians) * std::cos(axis.trend_deg * kRadians),
            -std::sin(axis.plunge_deg * kRadians)};
}

// Whether the ellipse around the fitted pole contains `normal`.
bool isInEllipse(const Attitude& attitude, const Vec3& normal)
{
    const Vec3 scaled = normal * (1.0 / dot(normal, attitude.normal));
    double sum = 0.0;
    for (const PoleAxis& axis : attitude.uncertainty.axes) {
        const double share =
            dot(scaled, fromTrend(axis)) / std::tan(axis.half_angle_deg * kRadians);
        sum += share * share;
    }
    return sum <= 1.0;
}

} // namespace

TEST(Attitude, SolvesTheThreePointProblemOfBennison)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    std::ifstream file(sharedData() / "oracle/three_point_bennison1990.txt");
    std::vector<TerrainPoint> points;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string name;
        TerrainPoint point;
        if (!line.starts_with("#") &&
            words >> name >> point.position.x >> point.position.y >> point.elevation_m) {
            points.push_back(point);
        }
    }
    ASSERT_EQ(points.size(), 3U);
    for (const double up_m : {0.0, 400.0}) { // the lower and the upper seam
        for (TerrainPoint& point : points) {
            point.elevation_m += up_m;
        }
        const auto attitude =
            fitAttitude(Ground::onPlane(), points, {.default_elevation_error_m = 1.0});
        ASSERT_TRUE(attitude) << attitude.error().message;
        EXPECT_NEAR(attitude->strike_deg, 106.45, 0.005);
        EXPECT_NEAR(attitude->dip_deg, 7.37, 0.005);
        EXPECT_NEAR(attitude->dip_direction_deg, 196.45, 0.005);
        EXPECT_LT(attitude->rms_m, 1e-9);
        EXPECT_FALSE(attitude->hasResiduals());
        EXPECT_FALSE(attitude->uncertainty.is_estimated) << "the step of samples is no error";
    }
}

TEST(Attitude, EstimatesErrorsOnlyFromResidualsOrStatedOnes)
{
    std::vector<TerrainPoint> points{{.position = {0.0, 0.0}, .elevation_m = 0.0},
                                     {.position = {100.0, 0.0}, .elevation_m = 10.0},
                                     {.position = {0.0, 100.0}, .elevation_m = 0.0}};
    const AttitudeOptions of_samples{.default_elevation_error_m = 0.5};
    const auto three = fitAttitude(Ground::onPlane(), points, of_samples);
    ASSERT_TRUE(three) << three.error().message;
    EXPECT_FALSE(three->hasResiduals());
    EXPECT_FALSE(three->uncertainty.is_estimated);
    const auto stated = fitAttitude(Ground::onPlane(), points, {.elevation_error_m = 1.0});
    ASSERT_TRUE(stated) << stated.error().message;
    EXPECT_TRUE(stated->uncertainty.is_estimated);
    points.push_back({.position = {100.0, 100.0}, .elevation_m = 10.2});
    const auto four = fitAttitude(Ground::onPlane(), points, of_samples);
    ASSERT_TRUE(four) << four.error().message;
    EXPECT_TRUE(four->hasResiduals());
    EXPECT_TRUE(four->uncertainty.is_estimated);
}

TEST(Attitude, IsThatOfAKnownPlaneInTenProjectionsAtTenPlaces)
{
    const std::vector<std::pair<double, double>> places{
        {0.0, 0.0},   {179.99, 10.0}, {226.2, 18.65},  {-60.0, -45.0}, {137.4, -4.6},
        {30.0, 60.0}, {77.5, 75.0},   {-120.0, -80.0}, {300.0, 35.0},  {100.0, 84.0}};
    // Centered 25° to the west, so that north in the map is not north on the ground.
    const std::vector<std::string> projections{"+proj=longlat",
                                               "+proj=tmerc +lat_0={1} +lon_0={0}",
                                               "+proj=merc +lon_0={0}",
                                               "+proj=sinu +lon_0={0}",
                                               "+proj=laea +lat_0={1} +lon_0={0}",
                                               "+proj=aeqd +lat_0={1} +lon_0={0}",
                                               "+proj=stere +lat_0=90 +lon_0={0}",
                                               "+proj=lcc +lat_1=20 +lat_2=70 +lon_0={0}",
                                               "+proj=eqc +lon_0={0}",
                                               "+proj=moll +lon_0={0}"};
    constexpr double kEquatorialM = 3396190.0;
    constexpr double kPolarM = 3376200.0;
    Random random;
    MapMaker maker;
    double worst_dip = 0.0;
    double worst_strike = 0.0;
    int count = 0;
    for (const auto& [longitude, latitude] : places) {
        for (const std::string& projection : projections) {
            const bool is_south_pole_far =
                projection.find("+lat_0=90") != std::string::npos && latitude < -60.0;
            const bool is_conic_far =
                projection.find("lcc") != std::string::npos && latitude < -60.0;
            if (is_south_pole_far || is_conic_far) {
                continue; // stretched by more than a factor 10 there
            }
            const std::string srs =
                fmt::format(fmt::runtime(projection), longitude - 25.0, latitude) +
                fmt::format(" +a={} +b={} {}", kEquatorialM, kPolarM,
                            projection == "+proj=longlat" ? "" : "+units=m");
            SCOPED_TRACE(srs);
            const auto crs = Crs::fromText(srs);
            ASSERT_TRUE(crs) << crs.error().message;
            const Ellipsoid ellipsoid{kEquatorialM, kPolarM};
            const GeographicPoint center{Angle::degrees(longitude),
                                         ellipsoid.planetocentric(Angle::degrees(latitude))};
            const auto middle = crs->toMap(center);
            ASSERT_TRUE(middle);
            constexpr std::size_t kSide = 81;
            const double step = projection == "+proj=longlat" ? 20.0 / 59274.7 : 20.0;
            const std::array<double, 6> transform{middle->x - step * (0.5 * kSide), step, 0.0,
                                                  middle->y + step * (0.5 * kSide), 0.0,  -step};
            const Georeference georeference(kSide, kSide, *GeoTransform::fromTerms(transform),
                                            *crs);
            const double strike_deg = random.uniform(0.0, 360.0);
            const double dip_deg = random.uniform(2.0, 40.0);
            const Vec3 normal = normalOf(strike_deg, dip_deg);
            // Truth: the elevation at which the vertical of a position meets the plane.
            const GeographicLib::LocalCartesian frame(
                latitude, longitude, 0.0,
                GeographicLib::Geocentric(kEquatorialM, (kEquatorialM - kPolarM) / kEquatorialM));
            const auto map =
                maker.make({.columns = kSide, .rows = kSide, .transform = transform, .srs = srs},
                           [&](std::size_t c, std::size_t r) {
                               const auto at = georeference.toGeographic(
                                   {static_cast<double>(c), static_cast<double>(r)});
                               const double lat = ellipsoid.planetographic(at->latitude).degrees();
                               const auto above = [&](double h) {
                                   Vec3 p;
                                   frame.Forward(lat, at->longitude.degrees(), h, p.x, p.y, p.z);
                                   return dot(p, normal);
                               };
                               return above(0.0) / (above(0.0) - above(1.0));
                           });
            MeasuredTerrain terrain(map->georeference(), readSamples(map->heightfield()));
            std::vector<GroundPosition> positions;
            for (int i = 0; i < 8; ++i) {
                positions.push_back(*terrain.fromGrid(
                    {40.0 + 35.0 * std::cos(i * 0.8), 40.0 + 35.0 * std::sin(i * 0.8)}));
            }
            const auto attitude = measureAttitude(terrain, positions, {});
            ASSERT_TRUE(attitude) << attitude.error().message;
            const double dip_error = std::abs(attitude->dip_deg - dip_deg);
            const double strike_error = angleBetween(attitude->strike_deg, strike_deg);
            EXPECT_LT(dip_error, 0.02);
            EXPECT_LT(strike_error, 0.05);
            worst_dip = std::max(worst_dip, dip_error);
            worst_strike = std::max(worst_strike, strike_error);
            ++count;
        }
    }
    std::printf("%d rasters: dip within %.2g°, strike within %.2g°\n", count, worst_dip,
                worst_strike);
    EXPECT_GE(count, 96);
}

TEST(Attitude, RegionCoversTheTruePoleInNineteenOfTwentyCases)
{
    Random random;
    for (const int count : {4, 5, 8, 30}) {
        constexpr int kPlanes = 10'000;
        int covered = 0;
        int fitted = 0;
        for (int i = 0; i < kPlanes; ++i) {
            const double dip_deg = random.uniform(5.0, 80.0);
            const Vec3 normal = normalOf(random.uniform(0.0, 360.0), dip_deg);
            const Vec3 along = normalized(cross(normal, {0.0, 0.0, 1.0}));
            const Vec3 down = cross(normal, along);
            std::vector<TerrainPoint> points;
            for (int k = 0; k < count; ++k) {
                const double angle = 2.0 * std::numbers::pi * k / count;
                const Vec3 p = along * (300.0 * std::cos(angle)) +
                               down * (200.0 * std::sin(angle)) + normal * (0.5 * gaussian(random));
                points.push_back({{p.x, p.y}, p.z});
            }
            if (const auto attitude = fitAttitude(Ground::onPlane(), points, {})) {
                ++fitted;
                covered += isInEllipse(*attitude, normal) ? 1 : 0;
            }
        }
        const double share = static_cast<double>(covered) / fitted;
        std::printf("%d points: the region covers %.2f %% of %d planes\n", count, 100.0 * share,
                    fitted);
        EXPECT_GE(fitted, kPlanes * 99 / 100);
        EXPECT_GE(share, 0.94);
        EXPECT_LE(share, 0.96);
    }
}

TEST(Attitude, OfThreePointsHasTheErrorOfTheirElevations)
{
    Random random;
    constexpr int kPlanes = 10'000;
    int covered = 0;
    int dip_covered = 0;
    for (int i = 0; i < kPlanes; ++i) {
        const double dip_deg = random.uniform(5.0, 60.0);
        const Vec3 normal = normalOf(random.uniform(0.0, 360.0), dip_deg);
        std::vector<TerrainPoint> points;
        for (int k = 0; k < 3; ++k) {
            const double x = 300.0 * std::cos(2.1 * k);
            const double y = 300.0 * std::sin(2.1 * k);
            points.push_back(
                {{x, y}, -(normal.x * x + normal.y * y) / normal.z + 0.5 * gaussian(random)});
        }
        const auto attitude = fitAttitude(Ground::onPlane(), points, {.elevation_error_m = 0.5});
        ASSERT_TRUE(attitude);
        covered += isInEllipse(*attitude, normal) ? 1 : 0;
        dip_covered +=
            std::abs(attitude->dip_deg - dip_deg) <= attitude->uncertainty.dip_error_deg ? 1 : 0;
    }
    std::printf("the region covers %.2f %%, the dip's error %.2f %%\n", 100.0 * covered / kPlanes,
                100.0 * dip_covered / kPlanes);
    EXPECT_GE(covered, kPlanes * 94 / 100);
    EXPECT_LE(covered, kPlanes * 96 / 100);
    EXPECT_GE(dip_covered, covered); // the error is that of the whole region
}

TEST(Attitude, DependsNeitherOnTheOrderOfPointsNorOnWholeTurns)
{
    Random random;
    const Ground mars = Ground::onEllipsoid({3396190.0, 3376200.0});
    std::vector<TerrainPoint> points;
    for (int i = 0; i < 12; ++i) {
        const double x = random.uniform(-0.01, 0.01);
        const double y = random.uniform(-0.01, 0.01);
        points.push_back(
            {{137.5 + x, -4.5 + y}, -4000.0 + 9000.0 * x - 4000.0 * y + random.uniform(-1.0, 1.0)});
    }
    const auto truth = fitAttitude(mars, points, {});
    ASSERT_TRUE(truth);
    for (int i = 0; i < 50; ++i) {
        std::vector<TerrainPoint> shuffled = points;
        for (std::size_t k = shuffled.size() - 1; k > 0; --k) {
            std::swap(shuffled[k], shuffled[random.below(k + 1)]);
        }
        const auto again = fitAttitude(mars, shuffled, {});
        ASSERT_TRUE(again);
        EXPECT_EQ(again->strike_deg, truth->strike_deg);
        EXPECT_EQ(again->dip_deg, truth->dip_deg);
        EXPECT_EQ(again->rms_m, truth->rms_m);
        for (TerrainPoint& point : shuffled) {
            point.position.x += random.chance(0.5) ? 360.0 : -720.0;
        }
        const auto turned = fitAttitude(mars, shuffled, {});
        ASSERT_TRUE(turned);
        EXPECT_NEAR(turned->strike_deg, truth->strike_deg, 1e-6);
        EXPECT_NEAR(turned->dip_deg, truth->dip_deg, 1e-6);
    }
}

TEST(Attitude, StatesErrorsOfDipAndStrike)
{
    // Four corners of a square of side 2a on a plane that dips to the east by 30°, moved by ±d
    // along its normal: the residuals are d each, s² = 4 d², and the tangents of both half angles
    // are s·√(2F)/(2a) with F(0.95; 2, 1) = 199.5.
    const double a = 1000.0;
    const double d = 0.01;
    const Vec3 normal = normalOf(0.0, 30.0);
    const Vec3 north{0.0, 1.0, 0.0};
    const Vec3 down = cross(north, normal);
    std::vector<TerrainPoint> points;
    for (int k = 0; k < 4; ++k) {
        const double x = (k & 1) != 0 ? a : -a;
        const double y = (k & 2) != 0 ? a : -a;
        const Vec3 p = down * x + north * y + normal * ((x > 0.0) == (y > 0.0) ? d : -d);
        points.push_back({{p.x, p.y}, p.z});
    }
    const auto attitude = fitAttitude(Ground::onPlane(), points, {});
    ASSERT_TRUE(attitude);
    const double half_angle = std::atan(2.0 * d * std::sqrt(2.0 * 199.5) / (2.0 * a)) / kRadians;
    EXPECT_NEAR(angleBetween(attitude->strike_deg, 0.0), 0.0, 1e-9);
    EXPECT_NEAR(attitude->dip_deg, 30.0, 1e-9);
    EXPECT_NEAR(attitude->rms_m, d, 1e-9);
    EXPECT_NEAR(attitude->uncertainty.axes[0].half_angle_deg, half_angle, 1e-6);
    EXPECT_NEAR(attitude->uncertainty.dip_error_deg, half_angle, 1e-4 * half_angle);
    EXPECT_NEAR(attitude->uncertainty.strike_error_deg, half_angle / 0.5, 1e-3 * half_angle);
    EXPECT_NEAR(attitude->poleTrendDeg(), 270.0, 1e-9);
    EXPECT_NEAR(attitude->polePlungeDeg(), 60.0, 1e-9);
}

TEST(Attitude, RefusesPointsWithoutAPlane)
{
    const auto refusal = [](const std::vector<TerrainPoint>& points) {
        const auto attitude =
            fitAttitude(Ground::onPlane(), points, {.default_elevation_error_m = 1.0});
        return attitude ? std::string() : attitude.error().message;
    };
    EXPECT_EQ(refusal({{{0.0, 0.0}, 1.0}, {{1.0, 0.0}, 1.0}}),
              "an attitude needs at least 3 positions, but there are 2");
    EXPECT_EQ(refusal({{{5.0, 5.0}, 1.0}, {{5.0, 5.0}, 1.0}, {{5.0, 5.0}, 1.0}}),
              "the points coincide, so they have no plane; choose points apart from each other");
    EXPECT_NE(refusal({{{0.0, 0.0}, 1.0}, {{500.0, 1.0}, 1.0}, {{1000.0, 0.0}, 1.0}})
                  .find("the points are nearly on a line (408 m long, 0.471 m wide)"),
              std::string::npos);
    // On a line in plan, though not in space: their plane would be vertical at any elevations.
    for (const double aside_m : {0.0, 1.0}) {
        EXPECT_NE(refusal({{{0.0, 0.0}, 100.0}, {{500.0, aside_m}, -300.0}, {{1000.0, 0.0}, 0.0}})
                      .find("the points are nearly on a line in plan (408 m long, "),
                  std::string::npos);
    }
    EXPECT_EQ(refusal({{{0.0, 0.0}, 100.0}, {{500.0, 50.0}, -300.0}, {{1000.0, 0.0}, 0.0}}), "");
    EXPECT_NE(
        refusal({{{0.0, 0.0}, 0.0}, {{1.0, 0.0}, 0.0}, {{0.0, 1.0}, 0.0}}).find("uncertain by"),
        std::string::npos);
}

} // namespace marsview::test
