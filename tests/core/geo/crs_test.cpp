#include "core/geo/crs.h"
#include "tests/support/gdal_tools.h"
#include "tests/support/random.h"
#include "tests/support/reference_ellipsoid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

namespace marsview {
namespace {

using test::Position;

constexpr long double kPi = std::numbers::pi_v<long double>;
constexpr long double kDegreeInRadians = kPi / 180.0L;

constexpr std::size_t kPositions = 1000;
constexpr double kTolerance_deg = 1e-9;
constexpr double kRoundTripTolerance = 3e-8; // map units

// ---- Against gdaltransform ------------------------------------------------------------------

// How gdaltransform writes coordinates of a CRS's own geographic system.
enum class BaseAxes {
    LongitudeLatitude,
    LatitudeWestLongitude, // IAU "Ographic": OGR's traditional axis order does not change these
};

struct Box {
    double west;
    double east;
    double south;
    double north;
};

struct OracleCase {
    std::string crs;
    std::string base; // its own geographic system
    double a;
    double b;
    Box box_deg; // in east-positive degrees from Greenwich, latitude as the base counts it
    BaseAxes axes = BaseAxes::LongitudeLatitude;
    LatitudeKind latitude = LatitudeKind::Planetographic;
    double unit_deg = 1.0; // degrees in one unit of the base
    double meridian_deg = 0.0;
};

constexpr double kA84 = 6378137.0;
constexpr double kB84 = 6356752.314245179;
constexpr double kB80 = 6356752.314140356; // GRS 1980
constexpr double kA66 = 6378206.4;         // Clarke 1866
constexpr double kB66 = 6356583.8;
constexpr double kABessel = 6377397.155;
constexpr double kBBessel = 6356078.962818189;
constexpr double kAClarke80Ign = 6378249.2;
constexpr double kBClarke80Ign = 6356515.0;
constexpr double kAMars = 3396190.0;
constexpr double kBMars = 3376200.0;
constexpr double kParis_deg = 2.5969213 * 0.9;

std::vector<OracleCase> oracleCases()
{
    const Box world{-179.0, 179.0, -85.0, 85.0};
    const Box north{-180.0, 180.0, 40.0, 89.5};
    const Box south{-180.0, 180.0, -89.5, -40.0};
    const std::string mars_ellipsoid = "+proj=longlat +a=3396190 +b=3376200 +no_defs";
    const std::string mars_sphere = "+proj=longlat +R=3396190 +no_defs";
    constexpr auto kWest = BaseAxes::LatitudeWestLongitude;
    constexpr auto kEast = BaseAxes::LongitudeLatitude;
    constexpr auto kCentric = LatitudeKind::Planetocentric;
    return {
        {"EPSG:32610", "EPSG:4326", kA84, kB84, {-128, -118, 0.5, 84}},
        {"EPSG:32601", "EPSG:4326", kA84, kB84, {-183, -171, 0.5, 84}},
        {"EPSG:32660", "EPSG:4326", kA84, kB84, {171, 183, 0.5, 84}},
        {"EPSG:32733", "EPSG:4326", kA84, kB84, {11, 19, -80, -0.5}},
        {"EPSG:26713", "EPSG:4267", kA66, kB66, {-109, -101, 20, 60}},
        {"EPSG:2853", "EPSG:4152", kA84, kB80, {-80, -76, 37, 40}},
        {"EPSG:2924", "EPSG:4152", kA84, kB80, {-80, -76, 37, 40}}, // feet
        {"EPSG:3031", "EPSG:4326", kA84, kB84, south},
        {"EPSG:3995", "EPSG:4326", kA84, kB84, north},
        {"EPSG:3413", "EPSG:4326", kA84, kB84, north},
        {"EPSG:5041", "EPSG:4326", kA84, kB84, north},  // UPS, easting first
        {"EPSG:32661", "EPSG:4326", kA84, kB84, north}, // UPS, northing first
        {"EPSG:3857", "EPSG:4326", kA84, kB84, world},
        {"EPSG:3395", "EPSG:4326", kA84, kB84, world},
        {"EPSG:6933", "EPSG:4326", kA84, kB84, world},
        {"EPSG:2056", "EPSG:4150", kABessel, kBBessel, {6, 10, 45, 48}},
        {"EPSG:21781", "EPSG:4149", kABessel, kBBessel, {6, 10, 45, 48}},
        {"EPSG:28992", "EPSG:4289", kABessel, kBBessel, {3, 7, 50, 54}},
        {"EPSG:27700", "EPSG:4277", 6377563.396, 6356256.909237285, {-8, 2, 50, 60}},
        {"EPSG:2193", "EPSG:4167", kA84, kB80, {166, 179, -48, -34}},
        {"EPSG:2048", "EPSG:4148", kA84, kB84, {18, 20, -34, -28}},
        {"EPSG:2053", "EPSG:4148", kA84, kB84, {28, 30, -33, -22}},
        {"EPSG:2154", "EPSG:4171", kA84, kB80, {-9, 10, 41, 51}},
        {"EPSG:27572",
         "EPSG:4807",
         kAClarke80Ign,
         kBClarke80Ign,
         {-4, 8, 45, 48},
         kEast,
         LatitudeKind::Planetographic,
         0.9,
         kParis_deg},
        {"EPSG:5514", "EPSG:4156", kABessel, kBBessel, {12, 22, 48, 51}}, // Krovak
        {"IAU_2015:49910", "IAU_2015:49900", kAMars, kAMars, world},
        {"IAU_2015:49911", "IAU_2015:49901", kAMars, kBMars, world, kWest},
        {"IAU_2015:49912", "IAU_2015:49902", kAMars, kBMars, world, kEast, kCentric},
        {"IAU_2015:49915", "IAU_2015:49900", kAMars, kAMars, {1, 359, -85, 85}},
        {"IAU_2015:49920", "IAU_2015:49900", kAMars, kAMars, world},
        {"IAU_2015:49921", "IAU_2015:49901", kAMars, kBMars, world, kWest},
        {"IAU_2015:49922", "IAU_2015:49902", kAMars, kBMars, world, kEast, kCentric},
        {"IAU_2015:49930", "IAU_2015:49900", kAMars, kAMars, north},
        {"IAU_2015:49931", "IAU_2015:49901", kAMars, kBMars, north, kWest},
        {"IAU_2015:49932", "IAU_2015:49902", kAMars, kBMars, north, kEast, kCentric},
        {"IAU_2015:49935", "IAU_2015:49900", kAMars, kAMars, south},
        {"IAU_2015:49936", "IAU_2015:49901", kAMars, kBMars, south, kWest},
        {"IAU_2015:49937", "IAU_2015:49902", kAMars, kBMars, south, kEast, kCentric},
        {"IAU_2015:49960", "IAU_2015:49900", kAMars, kAMars, {-30, 30, -80, 80}},
        {"IAU_2015:49980", "IAU_2015:49900", kAMars, kAMars, {-120, 120, -80, 80}},
        {"IAU_2015:30110", "IAU_2015:30100", 1737400.0, 1737400.0, world},
        {"IAU_2015:30135", "IAU_2015:30100", 1737400.0, 1737400.0, south},
        {"IAU_2015:19910", "IAU_2015:19900", 2440530.0, 2440530.0, world},
        {"IAU_2015:60610", "IAU_2015:60600", 2575000.0, 2575000.0, world},
        {"+proj=eqc +lon_0=180 +a=3396190 +b=3376200 +units=m +no_defs",
         mars_ellipsoid,
         kAMars,
         kBMars,
         {1, 359, -89, 89}},
        {"+proj=sinu +lon_0=0 +R=3396190 +units=m +no_defs", mars_sphere, kAMars, kAMars, world},
        {"+proj=laea +lat_0=30 +lon_0=100 +a=3396190 +b=3376200 +no_defs",
         mars_ellipsoid,
         kAMars,
         kBMars,
         {0, 200, -50, 89}},
        {"+proj=ortho +lat_0=40 +lon_0=-30 +R=3396190 +no_defs",
         mars_sphere,
         kAMars,
         kAMars,
         {-80, 20, 5, 75}},
        {"+proj=merc +lon_0=20 +a=3396190 +b=3376200 +no_defs",
         mars_ellipsoid,
         kAMars,
         kBMars,
         {-150, 190, -80, 80}},
        {"+proj=omerc +lat_0=20 +lonc=226 +alpha=30 +k=1 +a=3396190 +b=3376200 +no_defs",
         mars_ellipsoid,
         kAMars,
         kBMars,
         {210, 240, 0, 40}},
    };
}

void PrintTo(const OracleCase& c, std::ostream* stream)
{
    *stream << c.crs;
}

class CrsOracle : public testing::TestWithParam<OracleCase> {};

// Test names: the CRS text without characters that are not allowed in a name.
std::string caseName(const testing::TestParamInfo<OracleCase>& info)
{
    std::string name = info.param.crs.substr(0, info.param.crs.find(" +a"));
    name = name.substr(0, name.find(" +R"));
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

TEST_P(CrsOracle, LongitudeAndLatitudeMatchGdaltransform)
{
    const OracleCase& c = GetParam();
    test::Random random;
    std::vector<Position> base;
    for (std::size_t i = 0; i < kPositions; ++i) {
        const double longitude =
            (random.uniform(c.box_deg.west, c.box_deg.east) - c.meridian_deg) / c.unit_deg;
        const double latitude = random.uniform(c.box_deg.south, c.box_deg.north) / c.unit_deg;
        base.push_back(c.axes == BaseAxes::LongitudeLatitude ? Position{longitude, latitude}
                                                             : Position{latitude, -longitude});
    }
    const std::vector<Position> map = test::transformed(c.base, c.crs, base);
    const std::vector<Position> back = test::transformed(c.crs, c.base, map);

    const auto crs = Crs::fromText(c.crs);
    ASSERT_TRUE(crs) << crs.error().message;
    ASSERT_TRUE(crs->ellipsoid());
    EXPECT_NEAR(crs->ellipsoid()->equatorial_m, c.a, 1e-6);
    EXPECT_NEAR(crs->ellipsoid()->polar_m, c.b, 1e-6);
    // PROJ's own inverse of ellipsoidal equal-area projections is only accurate to millimeters.
    // Where its round trip fails, the oracle has that error; our inverse is verified by its own
    // round trip.
    const std::vector<Position> again = test::transformed(c.base, c.crs, back);
    const auto oracle_error_deg = [&](std::size_t i) {
        const double meters =
            std::hypot(again[i].x - map[i].x, again[i].y - map[i].y) * crs->unit();
        return crs->kind() == CrsKind::Projected ? meters / c.b / kDegreeInRadians : 0.0L;
    };
    long double worst_deg = 0.0L;
    double worst_map = 0.0;
    for (std::size_t i = 0; i < kPositions; ++i) {
        SCOPED_TRACE(fmt::format("{} at {:.17g} {:.17g}", c.crs, map[i].x, map[i].y));
        const bool is_usual = c.axes == BaseAxes::LongitudeLatitude;
        const long double longitude =
            (is_usual ? back[i].x : -back[i].y) * static_cast<long double>(c.unit_deg) +
            c.meridian_deg;
        const long double own_latitude =
            (is_usual ? back[i].y : back[i].x) * static_cast<long double>(c.unit_deg);
        const long double latitude = c.latitude == LatitudeKind::Planetographic
                                         ? test::centricLatitude_deg(c.a, c.b, own_latitude)
                                         : own_latitude;
        const auto geographic = crs->toGeographic({map[i].x, map[i].y});
        ASSERT_TRUE(geographic);
        const long double error_deg = std::max(
            std::abs(test::turnlessDifference_deg(geographic->longitude.degrees(), longitude)),
            std::abs(geographic->latitude.degrees() - latitude));
        worst_deg = std::max(worst_deg, error_deg);
        ASSERT_LT(error_deg, kTolerance_deg + 4.0L * oracle_error_deg(i))
            << fmt::format("found {:.12f} {:.12f}, expected {:.12f} {:.12f}",
                           geographic->longitude.degrees(), geographic->latitude.degrees(),
                           static_cast<double>(longitude), static_cast<double>(latitude));
        // Back to map coordinates. The same tolerance: degrees of arc times the radius.
        const auto returned = crs->toMap(*geographic);
        ASSERT_TRUE(returned);
        const double error_map = std::hypot(returned->x - map[i].x, returned->y - map[i].y);
        worst_map = std::max(worst_map, error_map);
    }
    std::printf("%s: %zu positions, worst %.3Lg degrees, round trip %.3g map units\n",
                c.crs.c_str(), kPositions, worst_deg, worst_map);
    EXPECT_LT(worst_map, kRoundTripTolerance);
}

INSTANTIATE_TEST_SUITE_P(Registries, CrsOracle, testing::ValuesIn(oracleCases()), caseName);

// ---- Against the projections' own formulas --------------------------------------------------

// Snyder (1987), Map Projections: A Working Manual, USGS Professional Paper 1395. Longitude
// relative to the central meridian, latitude planetographic, both in radians.
struct Plane {
    long double x;
    long double y;
};

Plane equirectangular(long double a, long double lambda, long double phi)
{
    return {a * lambda, a * phi};
}

Plane sinusoidal(long double a, long double b, long double lambda, long double phi)
{
    // Meridian lengths by Simpson's rule, parallels by their radius.
    constexpr int kSteps = 512;
    const auto radius = [&](long double angle) {
        return test::meridianRadius(a, b, angle / kDegreeInRadians);
    };
    long double sum = radius(0.0L) + radius(phi);
    for (int i = 1; i < kSteps; ++i) {
        sum += (i % 2 == 1 ? 4.0L : 2.0L) * radius(phi * i / kSteps);
    }
    return {test::parallelRadius(a, b, phi / kDegreeInRadians) * lambda,
            sum * phi / (3.0L * kSteps)};
}

Plane polarStereographic(
    long double a, long double b, long double lambda, long double phi, bool is_south)
{
    const long double e = std::sqrt(1.0L - (b / a) * (b / a));
    const long double p = is_south ? -phi : phi;
    const long double t = std::tan(kPi / 4.0L - p / 2.0L) /
                          std::pow((1.0L - e * std::sin(p)) / (1.0L + e * std::sin(p)), e / 2.0L);
    const long double rho =
        2.0L * a * t / std::sqrt(std::pow(1.0L + e, 1.0L + e) * std::pow(1.0L - e, 1.0L - e));
    return {rho * std::sin(lambda), (is_south ? 1.0L : -1.0L) * rho * std::cos(lambda)};
}

Plane mercator(long double a, long double b, long double lambda, long double phi)
{
    const long double e = std::sqrt(1.0L - (b / a) * (b / a));
    return {a * lambda, a * (std::asinh(std::tan(phi)) - e * std::atanh(e * std::sin(phi)))};
}

using Projection = Plane (*)(long double a, long double b, long double lambda, long double phi);

struct FormulaCase {
    const char* name;
    const char* crs;
    double a;
    double b;
    Projection projection;
    double central_meridian_deg;
    double x_sign; // -1 where map x grows westward
    double latitude_min_deg;
    double latitude_max_deg;
};

const Projection kEquirectangular = [](long double a, long double, long double l, long double p) {
    return equirectangular(a, l, p);
};
const Projection kSinusoidal = sinusoidal;
const Projection kNorthPolar = [](long double a, long double b, long double l, long double p) {
    return polarStereographic(a, b, l, p, false);
};
const Projection kSouthPolar = [](long double a, long double b, long double l, long double p) {
    return polarStereographic(a, b, l, p, true);
};
const Projection kMercator = mercator;

std::vector<FormulaCase> formulaCases()
{
    const double a = kAMars;
    const double b = kBMars;
    return {
        {"SphereEqc", "IAU_2015:49910", a, a, kEquirectangular, 0, 1, -89, 89},
        {"OgraphicEqc", "IAU_2015:49911", a, b, kEquirectangular, 0, -1, -89, 89},
        {"OcentricEqc", "IAU_2015:49912", a, b, kEquirectangular, 0, 1, -89, 89},
        {"SphereSinu", "IAU_2015:49920", a, a, kSinusoidal, 0, 1, -85, 85},
        {"OgraphicSinu", "IAU_2015:49921", a, b, kSinusoidal, 0, -1, -85, 85},
        {"OcentricSinu", "IAU_2015:49922", a, b, kSinusoidal, 0, 1, -85, 85},
        {"SphereNorth", "IAU_2015:49930", a, a, kNorthPolar, 0, 1, 30, 89.5},
        {"OgraphicNorth", "IAU_2015:49931", a, b, kNorthPolar, 0, -1, 30, 89.5},
        {"OcentricNorth", "IAU_2015:49932", a, b, kNorthPolar, 0, 1, 30, 89.5},
        {"SphereSouth", "IAU_2015:49935", a, a, kSouthPolar, 0, 1, -89.5, -30},
        {"OgraphicSouth", "IAU_2015:49936", a, b, kSouthPolar, 0, -1, -89.5, -30},
        {"OcentricSouth", "IAU_2015:49937", a, b, kSouthPolar, 0, 1, -89.5, -30},
        {"MoonEqc", "IAU_2015:30110", 1737400, 1737400, kEquirectangular, 0, 1, -89, 89},
        {"MoonSouth", "IAU_2015:30135", 1737400, 1737400, kSouthPolar, 0, 1, -89.5, -30},
        {"VestaEqc", "+proj=eqc +a=284500 +b=229000 +lon_0=0 +no_defs", 284500, 229000,
         kEquirectangular, 0, 1, -89, 89},
        {"Eqc180", "+proj=eqc +lon_0=180 +a=3396190 +b=3376200 +no_defs", a, b, kEquirectangular,
         180, 1, -89, 89},
        {"Sinu", "+proj=sinu +lon_0=0 +R=3396190 +no_defs", a, a, kSinusoidal, 0, 1, -85, 85},
        {"Merc", "+proj=merc +lon_0=20 +a=3396190 +b=3376200 +no_defs", a, b, kMercator, 20, 1, -85,
         85},
    };
}

void PrintTo(const FormulaCase& c, std::ostream* stream)
{
    *stream << c.crs;
}

class CrsFormula : public testing::TestWithParam<FormulaCase> {};

TEST_P(CrsFormula, MapCoordinatesMatchTheProjectionsFormula)
{
    const FormulaCase& c = GetParam();
    const auto crs = Crs::fromText(c.crs);
    ASSERT_TRUE(crs) << crs.error().message;
    test::Random random;
    long double worst_m = 0.0L;
    long double worst_deg = 0.0L;
    for (std::size_t i = 0; i < kPositions; ++i) {
        // Longitude east of the central meridian; the latitude type that the projection expects.
        const double east_deg = random.uniform(-179.0, 179.0);
        const double graphic_deg = random.uniform(c.latitude_min_deg, c.latitude_max_deg);
        SCOPED_TRACE(fmt::format("{} at {:.17g} {:.17g}", c.crs, east_deg, graphic_deg));
        const Plane plane =
            c.projection(c.a, c.b, east_deg * kDegreeInRadians, graphic_deg * kDegreeInRadians);
        const long double x = static_cast<long double>(c.x_sign) * plane.x;
        const long double centric = test::centricLatitude_deg(c.a, c.b, graphic_deg);
        const auto map = crs->toMap({Angle::degrees(east_deg + c.central_meridian_deg),
                                     Angle::degrees(static_cast<double>(centric))});
        ASSERT_TRUE(map);
        const long double error_m = std::hypot(map->x - x, map->y - plane.y);
        worst_m = std::max(worst_m, error_m);
        // PROJ's series for meridian lengths is accurate to 30 micrometers on Mars (5e-10 degrees);
        // the other forward formulas are closed.
        ASSERT_LT(error_m, 5e-5L);
        const auto geographic =
            crs->toGeographic({static_cast<double>(x), static_cast<double>(plane.y)});
        ASSERT_TRUE(geographic);
        const long double error_deg =
            std::max(std::abs(test::turnlessDifference_deg(geographic->longitude.degrees(),
                                                           east_deg + c.central_meridian_deg)) *
                         std::cos(graphic_deg * kDegreeInRadians),
                     std::abs(geographic->latitude.degrees() - centric));
        worst_deg = std::max(worst_deg, error_deg);
        ASSERT_LT(error_deg, kTolerance_deg + 4.0L * error_m / c.b / kDegreeInRadians);
    }
    std::printf("%s: %zu positions, worst %.3Lg m, %.3Lg degrees\n", c.crs, kPositions, worst_m,
                worst_deg);
}

INSTANTIATE_TEST_SUITE_P(Planets,
                         CrsFormula,
                         testing::ValuesIn(formulaCases()),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

// ---- Geographic systems ---------------------------------------------------------------------

TEST(Crs, GeographicSystemsDifferInUnitSignAndMeridianOnly)
{
    const struct {
        const char* crs;
        double a;
        double b;
        double unit_deg;
        double meridian_deg;
        double east_sign;
        bool is_centric;
    } cases[] = {
        {"EPSG:4326", kA84, kB84, 1.0, 0.0, 1.0, false},
        {"EPSG:4267", kA66, kB66, 1.0, 0.0, 1.0, false},
        {"EPSG:4807", kAClarke80Ign, kBClarke80Ign, 0.9, kParis_deg, 1.0, false},
        {"EPSG:4813", kABessel, kBBessel, 1.0, 106.0 + 48.0 / 60.0 + 27.79 / 3600.0, 1.0, false},
        {"IAU_2015:49900", kAMars, kAMars, 1.0, 0.0, 1.0, false},
        {"IAU_2015:49901", kAMars, kBMars, 1.0, 0.0, -1.0, false},
        {"IAU_2015:49902", kAMars, kBMars, 1.0, 0.0, 1.0, true},
        {"IAU_2015:30100", 1737400.0, 1737400.0, 1.0, 0.0, 1.0, false},
        {"IAU_2015:19902", 2440530.0, 2438260.0, 1.0, 0.0, 1.0, true},
        {"IAU_2015:60600", 2575000.0, 2575000.0, 1.0, 0.0, 1.0, false},
        {"IAU_2015:200000400", 255000.0, 255000.0, 1.0, 0.0, 1.0, false},
        {"+proj=longlat +a=3396190 +b=3376200 +no_defs", kAMars, kBMars, 1.0, 0.0, 1.0, false},
    };
    test::Random random;
    for (const auto& c : cases) {
        const auto crs = Crs::fromText(c.crs);
        ASSERT_TRUE(crs) << crs.error().message;
        EXPECT_EQ(crs->kind(), CrsKind::Geographic) << c.crs;
        EXPECT_NEAR(crs->ellipsoid()->equatorial_m, c.a, 1e-6) << c.crs;
        EXPECT_NEAR(crs->ellipsoid()->polar_m, c.b, 1e-6) << c.crs;
        EXPECT_EQ(crs->eastSign(), c.east_sign) << c.crs;
        EXPECT_EQ(crs->northSign(), 1.0) << c.crs;
        ASSERT_TRUE(crs->turn());
        EXPECT_NEAR(*crs->turn(), 360.0 / c.unit_deg, 1e-12) << c.crs;
        EXPECT_NEAR(crs->unit(), c.unit_deg * std::numbers::pi / 180.0, 1e-16) << c.crs;
        long double worst_deg = 0.0L;
        for (std::size_t i = 0; i < kPositions; ++i) {
            const MapPoint map{random.uniform(-360.0, 720.0) / c.unit_deg,
                               random.uniform(-90.0, 90.0) / c.unit_deg};
            const long double longitude =
                static_cast<long double>(c.east_sign) * map.x * c.unit_deg + c.meridian_deg;
            const long double own = static_cast<long double>(map.y) * c.unit_deg;
            const long double latitude =
                c.is_centric ? own : test::centricLatitude_deg(c.a, c.b, own);
            const auto geographic = crs->toGeographic(map);
            ASSERT_TRUE(geographic);
            // Whole turns are preserved: the plain difference, not the one modulo 360°.
            const long double error =
                std::max(std::abs(geographic->longitude.degrees() - longitude),
                         std::abs(geographic->latitude.degrees() - latitude));
            worst_deg = std::max(worst_deg, error);
            const auto again = crs->toMap(*geographic);
            ASSERT_TRUE(again);
            ASSERT_NEAR(again->x, map.x, 1e-12);
            // The inverse latitude conversion is this accurate down to a microdegree from the pole.
            ASSERT_NEAR(again->y, map.y, 1e-12);
        }
        EXPECT_LT(worst_deg, 1e-12) << c.crs;
        std::printf("%s: %zu positions, worst %.3Lg degrees\n", c.crs, kPositions, worst_deg);
    }
}

// OGR cannot convert from the system underlying a rotated pole. To use the rotated angles as
// longitude and latitude would be worse than an error.
TEST(Crs, RefusesARotatedPole)
{
    const auto crs = Crs::fromText(
        "+proj=ob_tran +o_proj=longlat +o_lon_p=40 +o_lat_p=50 "
        "+lon_0=30 +R=3396190 +type=crs");
    ASSERT_FALSE(crs);
    EXPECT_EQ(crs.error().code, ErrorCode::Unsupported);
    EXPECT_EQ(crs.error().message.find('\n'), std::string::npos);
}

TEST(Crs, IsEmptyBeyondThePoles)
{
    for (const char* text : {"EPSG:4326", "IAU_2015:49900", "IAU_2015:49901", "IAU_2015:49902"}) {
        const auto crs = Crs::fromText(text);
        ASSERT_TRUE(crs);
        for (const double latitude : {90.5, -90.25, 95.0, 1e9, std::nan("")}) {
            EXPECT_FALSE(crs->toGeographic({10.0, latitude})) << text << " " << latitude;
        }
        EXPECT_FALSE(crs->toGeographic({std::nan(""), 10.0})) << text;
        // A sample at the pole may miss it by the rounding error of its geotransform.
        for (const double latitude : {90.0, -90.0, 90.00000000000003, -90.00000000000003}) {
            const auto pole = crs->toGeographic({10.0, latitude});
            ASSERT_TRUE(pole) << text << " " << latitude;
            EXPECT_LE(std::abs(pole->latitude.degrees()), 90.0);
            EXPECT_NEAR(std::abs(pole->latitude.degrees()), 90.0, 1e-12);
        }
    }
}

// ---- What a CRS reports about itself ---------------------------------------------------------

TEST(Crs, FindsTheBodyByNameOrElseByRadius)
{
    const std::pair<const char*, const char*> table[] = {
        {"EPSG:4326", "Earth"},
        {"EPSG:32610", "Earth"},
        {"EPSG:26713", "Earth"},
        {"EPSG:27572", "Earth"},
        {"EPSG:2056", "Earth"},
        {"IAU_2015:49910", "Mars"},
        {"IAU_2015:49902", "Mars"},
        {"IAU_2015:30110", "Moon"},
        {"IAU_2015:19910", "Mercury"},
        {"IAU_2015:60610", "Titan"},
        {"IAU_2015:200000400", "Vesta"},
        {"ESRI:104905", "Mars"},
        {"ESRI:104903", "Moon"},
        {"+proj=eqc +R=3396000 +no_defs", "Mars"},
        {"+proj=eqc +R=1737400 +no_defs", "Moon"},
        {"+proj=longlat +a=6378137 +b=6356752.3 +no_defs", "Earth"},
    };
    for (const auto& [text, body] : table) {
        const auto crs = Crs::fromText(text);
        ASSERT_TRUE(crs) << text;
        ASSERT_NE(crs->body(), nullptr) << text;
        EXPECT_EQ(crs->body()->name, body) << text;
    }
    const auto nowhere = Crs::fromText("+proj=longlat +R=123456 +no_defs");
    ASSERT_TRUE(nowhere);
    EXPECT_EQ(nowhere->body(), nullptr);
}

TEST(Crs, LinearUnitsMatchTheProjection)
{
    EXPECT_EQ(Crs::fromText("EPSG:32610")->unit(), 1.0);
    EXPECT_NEAR(Crs::fromText("EPSG:2225")->unit(), 1200.0 / 3937.0,
                1e-15);                                    // California zone 1, ftUS
    EXPECT_EQ(Crs::fromText("EPSG:2222")->unit(), 0.3048); // Arizona East, ft
    EXPECT_EQ(Crs::fromText("+proj=eqc +R=3396190 +units=km +no_defs")->unit(), 1000.0);
    EXPECT_EQ(Crs::fromText("EPSG:2225")->unitName(), "US survey foot");
}

TEST(Crs, ATurnIsTheLengthOfTheEquatorInMapUnits)
{
    const auto turn = [](const char* text) { return Crs::fromText(text)->turn(); };
    const double mars = 2.0 * std::numbers::pi * kAMars;
    EXPECT_NEAR(*turn("IAU_2015:49910"), mars, 1e-6);
    EXPECT_NEAR(*turn("IAU_2015:49911"), mars, 1e-6);
    EXPECT_NEAR(*turn("IAU_2015:49915"), mars, 1e-6);
    EXPECT_NEAR(*turn("+proj=eqc +lat_ts=60 +R=3396190 +no_defs"), mars / 2.0, 1e-6);
    EXPECT_NEAR(*turn("EPSG:3857"), 2.0 * std::numbers::pi * kA84, 1e-6);
    EXPECT_NEAR(*turn("EPSG:3395"), 2.0 * std::numbers::pi * kA84, 1e-6);
    EXPECT_NEAR(*turn("EPSG:4326"), 360.0, 1e-12);
    EXPECT_NEAR(*turn("EPSG:4807"), 400.0, 1e-12);
    EXPECT_FALSE(turn("EPSG:32610"));
    EXPECT_FALSE(turn("IAU_2015:49930"));
    EXPECT_FALSE(turn("+proj=sinu +R=3396190 +no_defs"));
}

TEST(Crs, VerticalPartsOfCompoundSystemsAreKept)
{
    const auto feet = Crs::fromText("EPSG:32610+6360"); // NAVD88 height (ftUS)
    ASSERT_TRUE(feet) << feet.error().message;
    ASSERT_TRUE(feet->verticalUnit());
    EXPECT_EQ(feet->verticalUnit()->name, "US survey ft");
    EXPECT_NE(feet->verticalDatumName().find("NAVD88"), std::string::npos);
    const auto meters = Crs::fromText("EPSG:4326+5773"); // EGM96 height
    ASSERT_TRUE(meters) << meters.error().message;
    ASSERT_TRUE(meters->verticalUnit());
    EXPECT_EQ(meters->verticalUnit()->meters, 1.0);
    EXPECT_EQ(meters->kind(), CrsKind::Geographic);
    EXPECT_FALSE(Crs::fromText("EPSG:32610")->verticalUnit());
}

TEST(Crs, ALocalSystemHasNoGeographicCoordinates)
{
    const auto local = Crs::fromText("LOCAL_CS[\"site\",UNIT[\"foot\",0.3048]]");
    ASSERT_TRUE(local) << local.error().message;
    EXPECT_EQ(local->kind(), CrsKind::Local);
    EXPECT_EQ(local->unit(), 0.3048);
    EXPECT_FALSE(local->ellipsoid());
    EXPECT_EQ(local->body(), nullptr);
    EXPECT_FALSE(local->toGeographic({1.0, 2.0}));
    EXPECT_FALSE(local->toMap({Angle::degrees(1.0), Angle::degrees(2.0)}));
}

TEST(Crs, PointsOutsideTheProjectionHaveNoCoordinates)
{
    const auto ortho = Crs::fromText("+proj=ortho +lat_0=0 +lon_0=0 +R=3396190 +no_defs");
    ASSERT_TRUE(ortho);
    EXPECT_FALSE(ortho->toGeographic({4e6, 0.0}));
    EXPECT_FALSE(ortho->toMap({Angle::degrees(170.0), Angle::degrees(0.0)}));
    const auto utm = Crs::fromText("EPSG:32610");
    for (const double bad : {std::nan(""), static_cast<double>(INFINITY)}) {
        EXPECT_FALSE(utm->toGeographic({bad, 4e6})) << bad;
        EXPECT_FALSE(utm->toGeographic({5e5, bad})) << bad;
    }
}

TEST(Crs, RefusesInvalidTextInOneSentence)
{
    for (const char* text : {"", "garbage", "EPSG:", "EPSG:0", "EPSG:99999999", "+proj=nonsense",
                             "IAU_2015:1", "GEOGCS[\"broken\"", "/etc/passwd", "http://", "\n"}) {
        const auto crs = Crs::fromText(text);
        ASSERT_FALSE(crs) << text;
        const std::string& message = crs.error().message;
        EXPECT_FALSE(message.empty());
        EXPECT_NE(message.back(), '.') << message;
        if (std::string_view(text) != "\n") {
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }
    }
}

TEST(Crs, RefusesAGeocentricSystem)
{
    const auto crs = Crs::fromText("EPSG:4978");
    ASSERT_FALSE(crs);
    EXPECT_EQ(crs.error().code, ErrorCode::Unsupported);
    EXPECT_NE(crs.error().message.find("geocentric"), std::string::npos);
}

TEST(Crs, RefusesAVerticalSystemAlone)
{
    for (const char* text : {"EPSG:5703", "EPSG:5773"}) {
        const auto crs = Crs::fromText(text);
        ASSERT_FALSE(crs) << text;
        EXPECT_NE(crs.error().message.find("is vertical"), std::string::npos);
    }
    EXPECT_TRUE(Crs::fromText("EPSG:32610+5703"));
}

TEST(Crs, HasTheAreaOfUseOfItsRegistry)
{
    const auto area = Crs::fromText("EPSG:32633")->areaOfUse();
    ASSERT_TRUE(area);
    const auto at = [](double longitude, double latitude) {
        return GeographicPoint{Angle::degrees(longitude), Angle::degrees(latitude)};
    };
    EXPECT_TRUE(area->contains(at(15, 50)));
    EXPECT_TRUE(area->contains(at(15 - 360, 50)));
    EXPECT_FALSE(area->contains(at(10.5, 50)));
    EXPECT_FALSE(area->contains(at(15, -1)));
    const auto new_zealand = Crs::fromText("EPSG:3994")->areaOfUse(); // 155 to -169.99, -60 to -25
    ASSERT_TRUE(new_zealand);
    EXPECT_TRUE(new_zealand->contains(at(-178, -40)));
    EXPECT_TRUE(new_zealand->contains(at(175, -40)));
    EXPECT_FALSE(new_zealand->contains(at(0, -40)));
    EXPECT_FALSE(Crs::fromText("+proj=utm +zone=33 +datum=WGS84")->areaOfUse());
}

// ---- Another ellipsoid ----------------------------------------------------------------------

TEST(Crs, OnAnotherEllipsoidTheProjectionStaysAndTheBodyChanges)
{
    const auto earth = Crs::fromText("+proj=eqc +lon_0=180 +R=6371000 +no_defs");
    ASSERT_TRUE(earth);
    const auto mars = earth->onEllipsoid({kAMars, kBMars}, "Mars");
    ASSERT_TRUE(mars) << mars.error().message;
    EXPECT_EQ(*mars->ellipsoid(), (Ellipsoid{kAMars, kBMars}));
    ASSERT_NE(mars->body(), nullptr);
    EXPECT_EQ(mars->body()->name, "Mars");
    const auto point = mars->toGeographic({kAMars * std::numbers::pi / 6.0, kAMars * 0.5});
    ASSERT_TRUE(point);
    EXPECT_NEAR(std::remainder(point->longitude.degrees() - 210.0, 360.0), 0.0, 1e-9);
    EXPECT_NEAR(
        point->latitude.degrees(),
        static_cast<double>(test::centricLatitude_deg(kAMars, kBMars, 0.5L / kDegreeInRadians)),
        1e-9);
}

TEST(Crs, OnAnotherEllipsoidAnOcentricSystemStaysOcentric)
{
    const auto crs = Crs::fromText("IAU_2015:49902");
    ASSERT_TRUE(crs);
    const auto other = crs->onEllipsoid({3390000.0, 3300000.0}, "Mars");
    ASSERT_TRUE(other) << other.error().message;
    EXPECT_EQ(other->latitudeKind(), LatitudeKind::Planetocentric);
    const auto point = other->toGeographic({226.2, 18.65});
    ASSERT_TRUE(point);
    EXPECT_NEAR(point->longitude.degrees(), 226.2, 1e-12);
    EXPECT_NEAR(point->latitude.degrees(), 18.65, 1e-12);
}

TEST(Crs, OnAnotherEllipsoidWestwardAxesStayWestward)
{
    for (const char* text : {"IAU_2015:49901", "IAU_2015:49911", "EPSG:2053"}) {
        const auto crs = Crs::fromText(text);
        ASSERT_TRUE(crs);
        const auto other = crs->onEllipsoid({3390000.0, 3300000.0}, "Mars");
        ASSERT_TRUE(other) << other.error().message;
        EXPECT_EQ(other->eastSign(), crs->eastSign()) << text;
        EXPECT_EQ(other->northSign(), crs->northSign()) << text;
        // The same map point stays in the same quadrant of the body.
        const bool is_geographic = crs->kind() == CrsKind::Geographic;
        const MapPoint map = is_geographic ? MapPoint{10.0, 20.0} : MapPoint{1e5, 5e5};
        const auto before = crs->toGeographic(map);
        const auto after = other->toGeographic(map);
        ASSERT_TRUE(before && after) << text;
        EXPECT_NEAR(before->longitude.degrees(), after->longitude.degrees(), 6.0) << text;
        EXPECT_NEAR(before->latitude.degrees(), after->latitude.degrees(), 6.0) << text;
    }
}

TEST(Crs, AnotherEllipsoidKeepsUnitAndMeridianOfAGeographicSystem)
{
    const auto paris = Crs::fromText("EPSG:4807");
    ASSERT_TRUE(paris);
    const auto other = paris->onEllipsoid({kA84, kB84}, "Earth");
    ASSERT_TRUE(other) << other.error().message;
    const auto before = paris->toGeographic({3.0, 50.0});
    const auto after = other->toGeographic({3.0, 50.0});
    ASSERT_TRUE(before && after);
    EXPECT_NEAR(after->longitude.degrees(), before->longitude.degrees(), 1e-9);
    EXPECT_NEAR(after->latitude.degrees(), before->latitude.degrees(), 0.01);
}

TEST(Crs, RefusesRadiiThatDoNotFormAnEllipsoid)
{
    const auto crs = Crs::fromText("IAU_2015:49910");
    ASSERT_TRUE(crs);
    for (const Ellipsoid bad :
         {Ellipsoid{0.0, 0.0}, Ellipsoid{-1.0, -1.0}, Ellipsoid{1000.0, 2000.0},
          Ellipsoid{1000.0, 0.0}, Ellipsoid{NAN, 1.0}, Ellipsoid{1.0, NAN},
          Ellipsoid{INFINITY, 1.0}, Ellipsoid{INFINITY, INFINITY}}) {
        EXPECT_FALSE(crs->onEllipsoid(bad, "Mars")) << bad.equatorial_m << " " << bad.polar_m;
    }
    const auto local = Crs::fromText("LOCAL_CS[\"site\",UNIT[\"metre\",1]]");
    EXPECT_FALSE(local->onEllipsoid({1000.0, 900.0}, "Mars"));
}

TEST(Crs, ABodysSystemUsesItsKindOfLatitude)
{
    for (const Body& body : knownBodies()) {
        const Crs crs = Crs::geographic(body, body.ellipsoid);
        EXPECT_EQ(crs.kind(), CrsKind::Geographic);
        EXPECT_EQ(crs.latitudeKind(), body.latitude) << body.name;
        EXPECT_EQ(crs.body(), &body) << body.name;
        ASSERT_TRUE(crs.ellipsoid());
        EXPECT_NEAR(crs.ellipsoid()->equatorial_m, body.ellipsoid.equatorial_m, 1e-6);
        EXPECT_NEAR(crs.ellipsoid()->polar_m, body.ellipsoid.polar_m, 1e-6);
        const auto point = crs.toGeographic({100.0, 40.0});
        ASSERT_TRUE(point);
        EXPECT_NEAR(point->longitude.degrees(), 100.0, 1e-12);
    }
}

} // namespace
} // namespace marsview
