#include "core/geo/body.h"
#include "tests/support/random.h"
#include "tests/support/reference_ellipsoid.h"
#include "tests/support/run_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

namespace marsview {
namespace {

// An ulp of the angle, in degrees; near zero, that of the smallest angle that matters.
double ulp(double value)
{
    const double size = std::max(std::abs(value), std::numeric_limits<double>::min());
    return std::nextafter(size, INFINITY) - size;
}

std::vector<double> latitudes(test::Random& random)
{
    std::vector<double> degrees{
        0.0,    -0.0,  90.0,   -90.0,  45.0,          -45.0,
        1e-300, 1e-12, -1e-12, 1e-6,   89.999,        -89.99999999,
        30.0,   60.0,  18.65,  -42.43, 89.9999999999, std::nextafter(90.0, 0.0)};
    for (int i = 0; i < 5000; ++i) {
        degrees.push_back(random.uniform(-90.0, 90.0));
        degrees.push_back(
            std::copysign(90.0 - std::exp(random.uniform(-30.0, 0.0)), random.uniform(-1.0, 1.0)));
    }
    return degrees;
}

TEST(Ellipsoid, LatitudesAgreeWithTheClosedFormulaOnEveryBody)
{
    test::Random random;
    double worst_ulp = 0.0;
    for (const Body& body : knownBodies()) {
        const Ellipsoid& e = body.ellipsoid;
        for (const double degrees : latitudes(random)) {
            SCOPED_TRACE(fmt::format("{} at {:.17g}", body.name, degrees));
            // The reference starts from the angle passed in, including the rounding to radians.
            const Angle angle = Angle::degrees(degrees);
            const double centric = e.planetocentric(angle).radians();
            const double graphic = e.planetographic(angle).radians();
            constexpr long double kDegree = std::numbers::pi_v<long double> / 180.0L;
            const long double given = angle.radians() / kDegree;
            const auto expected_centric = static_cast<double>(
                test::centricLatitude_deg(e.equatorial_m, e.polar_m, given) * kDegree);
            const auto expected_graphic = static_cast<double>(
                test::graphicLatitude_deg(e.equatorial_m, e.polar_m, given) * kDegree);
            worst_ulp =
                std::max({worst_ulp, std::abs(centric - expected_centric) / ulp(expected_centric),
                          std::abs(graphic - expected_graphic) / ulp(expected_graphic)});
            ASSERT_NEAR(centric, expected_centric, 8.0 * ulp(expected_centric));
            ASSERT_NEAR(graphic, expected_graphic, 8.0 * ulp(expected_graphic));
        }
    }
    RecordProperty("worst_ulp", fmt::format("{}", worst_ulp));
    std::printf("worst error %.2f ulp\n", worst_ulp);
}

TEST(Ellipsoid, ThePolesAndTheEquatorAreFixedPoints)
{
    for (const Body& body : knownBodies()) {
        for (const double degrees : {0.0, 90.0, -90.0}) {
            const Angle angle = Angle::degrees(degrees);
            EXPECT_EQ(body.ellipsoid.planetocentric(angle), angle) << body.name << " " << degrees;
            EXPECT_EQ(body.ellipsoid.planetographic(angle), angle) << body.name << " " << degrees;
        }
    }
}

TEST(Ellipsoid, PlanetographicLatitudeIsNeverCloserToTheEquator)
{
    test::Random random;
    for (const Body& body : knownBodies()) {
        for (int i = 0; i < 200; ++i) {
            const Angle centric = Angle::degrees(random.uniform(0.0, 90.0));
            const double ulps = 4.0 * ulp(centric.radians());
            EXPECT_GE(body.ellipsoid.planetographic(centric).radians(), centric.radians() - ulps);
        }
    }
}

// Two short geodesics from the same point, along the meridian and along the parallel: the distances
// from an independent program.
TEST(Ellipsoid, MetersPerRadianMatchLengthsOfShortGeodesics)
{
    if (test::runProgram({"GeodSolve", "--version"}).exit_status == 127) {
        GTEST_SKIP() << "GeodSolve (geographiclib-tools) is not installed";
    }
    constexpr double kStep_deg = 1e-4;
    constexpr double kDegree = std::numbers::pi / 180.0;
    for (const std::string_view name : {"Earth", "Mars", "Mercury", "Moon", "Vesta", "Phobos"}) {
        const Ellipsoid& e = bodyNamed(name)->ellipsoid;
        const std::vector<double> places{0.0, 0.001, 18.65, -42.43, 45.0, 70.0, -85.0, 89.0};
        std::string input; // no exponents: GeodSolve reads an "e" as east
        for (const double latitude : places) {
            input += fmt::format("{:.18f} 0 {:.18f} 0\n", latitude - kStep_deg / 2.0,
                                 latitude + kStep_deg / 2.0);
            input += fmt::format("{:.18f} 0 {:.18f} {:.18f}\n", latitude, latitude, kStep_deg);
            // The ends of a step of planetocentric latitude, as planetographic latitudes.
            const long double centric =
                test::centricLatitude_deg(e.equatorial_m, e.polar_m, latitude);
            const auto end = [&](double offset) {
                return static_cast<double>(
                    test::graphicLatitude_deg(e.equatorial_m, e.polar_m, centric + offset));
            };
            input +=
                fmt::format("{:.18f} 0 {:.18f} 0\n", end(-kStep_deg / 2.0), end(kStep_deg / 2.0));
        }
        std::istringstream output(
            test::runTool({"GeodSolve", "-E", "-e", fmt::format("{:.17g}", e.equatorial_m),
                           fmt::format("{:.17g}", e.flattening()), "-i", "-p", "9"},
                          input));
        const auto next_length = [&] {
            double azimuth_1 = 0.0;
            double azimuth_2 = 0.0;
            double length_m = 0.0;
            output >> azimuth_1 >> azimuth_2 >> length_m;
            return length_m;
        };
        for (const double latitude : places) {
            SCOPED_TRACE(fmt::format("{} at {}", name, latitude));
            const Angle graphic = Angle::degrees(latitude);
            const double step_rad = kStep_deg * kDegree;
            const double along_meridian_m = next_length();
            const double along_parallel_m = next_length();
            const double along_centric_m = next_length();
            // The chord is shorter than the parallel by (step · tan φ)²/24 of its length, 4e-10 at
            // worst here; GeodSolve is accurate to a few nanometers.
            const auto tolerance_m = [](double length_m) { return 1e-9 * length_m + 1e-8; };
            EXPECT_NEAR(e.metersPerRadianOfPlanetographicLatitude(graphic) * step_rad,
                        along_meridian_m, tolerance_m(along_meridian_m));
            EXPECT_NEAR(e.metersPerRadianOfLongitude(graphic) * step_rad, along_parallel_m,
                        tolerance_m(along_parallel_m));
            EXPECT_NEAR(e.metersPerRadianOfPlanetocentricLatitude(graphic) * step_rad,
                        along_centric_m, tolerance_m(along_centric_m));
        }
    }
}

TEST(Ellipsoid, MetersPerRadianMatchTheClosedFormula)
{
    test::Random random;
    for (const Body& body : knownBodies()) {
        const Ellipsoid& e = body.ellipsoid;
        for (int i = 0; i < 500; ++i) {
            const double latitude = random.uniform(-89.9, 89.9);
            const Angle graphic = Angle::degrees(latitude);
            const long double meridian = test::meridianRadius(e.equatorial_m, e.polar_m, latitude);
            const long double parallel = test::parallelRadius(e.equatorial_m, e.polar_m, latitude);
            ASSERT_NEAR(e.metersPerRadianOfPlanetographicLatitude(graphic),
                        static_cast<double>(meridian), 1e-14 * static_cast<double>(meridian));
            // The radius of the parallel decreases with tan(latitude) times the rounding of the
            // angle.
            ASSERT_NEAR(e.metersPerRadianOfLongitude(graphic), static_cast<double>(parallel),
                        1e-15 * e.equatorial_m);
        }
    }
}

TEST(WrapLongitude, LandsInTheRangeAndMovesByWholeTurnsOnly)
{
    test::Random random;
    const auto check = [](double degrees) {
        for (const LongitudeRange range :
             {LongitudeRange::From0To360, LongitudeRange::From180WestTo180East}) {
            const double low = range == LongitudeRange::From0To360 ? 0.0 : -180.0;
            const double wrapped = wrapLongitude(Angle::degrees(degrees), range).degrees();
            EXPECT_GE(wrapped, low) << degrees;
            EXPECT_LT(wrapped, low + 360.0) << degrees;
            const double tolerance = 4.0 * ulp(std::max(360.0, std::abs(degrees)));
            EXPECT_NEAR(std::remainder(wrapped - degrees, 360.0), 0.0, tolerance) << degrees;
            EXPECT_NEAR(wrapLongitude(Angle::degrees(wrapped), range).degrees(), wrapped,
                        tolerance);
        }
    };
    for (const double degrees : {0.0, -0.0, 180.0, -180.0, 360.0, -360.0, 540.0, 719.0, -1e-18,
                                 359.99999999999994, 360.00000000000006, -180.00000000000003}) {
        check(degrees);
    }
    for (int i = 0; i < 20000; ++i) {
        check(random.uniform(-2000.0, 2000.0));
    }
}

TEST(WrapLongitude, KeepsLongitudesInRangeBitForBit)
{
    test::Random random;
    for (int i = 0; i < 1000; ++i) {
        const Angle east = Angle::degrees(random.uniform(0.0, 360.0));
        EXPECT_EQ(wrapLongitude(east, LongitudeRange::From0To360), east);
        const Angle centered = Angle::degrees(random.uniform(-180.0, 180.0));
        EXPECT_EQ(wrapLongitude(centered, LongitudeRange::From180WestTo180East), centered);
    }
}

TEST(Body, EveryNameFindsItsOwnBodyInAnyCase)
{
    for (const Body& body : knownBodies()) {
        std::string upper(body.name);
        std::transform(upper.begin(), upper.end(), upper.begin(),
                       [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
        EXPECT_EQ(bodyNamed(body.name), &body);
        EXPECT_EQ(bodyNamed(upper), &body);
        EXPECT_EQ(bodyMentioned(body.name), &body);
    }
    EXPECT_EQ(bodyNamed("Terra"), bodyNamed("Earth"));
    EXPECT_EQ(bodyNamed(""), nullptr);
    EXPECT_EQ(bodyNamed("Vulcan"), nullptr);
    EXPECT_EQ(bodyNamed("Mars "), nullptr);
}

TEST(Body, RadiiMatchThePublishedTables)
{
    const auto radii = [](std::string_view name) {
        const Ellipsoid& e = bodyNamed(name)->ellipsoid;
        return std::pair(e.equatorial_m, e.polar_m);
    };
    EXPECT_EQ(radii("Mars"), std::pair(3396190.0, 3376200.0));
    EXPECT_EQ(radii("Moon"), std::pair(1737400.0, 1737400.0));
    EXPECT_EQ(radii("Mercury"), std::pair(2440530.0, 2438260.0));
    EXPECT_EQ(radii("Venus"), std::pair(6051800.0, 6051800.0));
    EXPECT_EQ(radii("Earth").first, 6378137.0);
    EXPECT_NEAR(bodyNamed("Earth")->ellipsoid.flattening(), 1.0 / 298.257223563, 1e-16);
    for (const Body& body : knownBodies()) {
        EXPECT_GT(body.ellipsoid.polar_m, 0.0) << body.name;
        EXPECT_GE(body.ellipsoid.equatorial_m, body.ellipsoid.polar_m) << body.name;
    }
}

TEST(Body, OnlyEarthUsesPlanetographicLatitude)
{
    for (const Body& body : knownBodies()) {
        EXPECT_EQ(body.latitude == LatitudeKind::Planetographic, body.name == "Earth") << body.name;
    }
}

TEST(BodyMentioned, UnderstandsDatumAndCrsNames)
{
    const std::pair<const char*, const char*> table[] = {
        {"D_MARS_2000", "Mars"},
        {"GCS_Mars_2000_Sphere", "Mars"},
        {"Mars (2015) - Sphere / Ocentric", "Mars"},
        {"SIMPLE_CYLINDRICAL MARS", "Mars"},
        {"PolarStereographic MARS", "Mars"},
        {"Mars_localRadius", "Mars"},
        {"Mars2000", "Mars"}, // a word ends before its digits
        {"GCS_Moon_2000", "Moon"},
        {"D_Moon_2000", "Moon"},
        {"LambertConformal MOON", "Moon"},
        {"Lunar 2000", "Moon"},
        {"WGS 84 / UTM zone 10N", "Earth"},
        {"WGS84", "Earth"},
        {"NAD27 / UTM zone 13N", "Earth"},
        {"NAD83(HARN) / Virginia North", "Earth"},
        {"Io", "Io"},
        {"D_Io_2000", "Io"},
        {"some region", nullptr},
        {"Radio station", nullptr},
        {"Marshall Islands 1960", nullptr},
        {"unionmars", nullptr},
        {"Titania (2015)", "Titania"},
        {"Titan (2015)", "Titan"},
        {"Vesta_2015", "Vesta"},
        {"", nullptr},
        {"unnamed", nullptr},
    };
    for (const auto& [text, name] : table) {
        const Body* body = bodyMentioned(text);
        EXPECT_EQ(body, name != nullptr ? bodyNamed(name) : nullptr) << text;
    }
}

TEST(BodyOfRadius, FindsTheNearestBodyWithinOnePercent)
{
    for (const Body& body : knownBodies()) {
        EXPECT_EQ(bodyOfRadius(body.ellipsoid.equatorial_m)->ellipsoid.equatorial_m,
                  body.ellipsoid.equatorial_m);
    }
    EXPECT_EQ(bodyOfRadius(3396000.0), bodyNamed("Mars"));
    EXPECT_EQ(bodyOfRadius(3394813.85797822), bodyNamed("Mars"));
    EXPECT_EQ(bodyOfRadius(6378206.4), bodyNamed("Earth"));
    EXPECT_EQ(bodyOfRadius(6371000.0), bodyNamed("Earth"));
    EXPECT_EQ(bodyOfRadius(3396190.0 * 1.011), nullptr);
    EXPECT_EQ(bodyOfRadius(0.0), nullptr);
    EXPECT_EQ(bodyOfRadius(-3396190.0), nullptr);
    EXPECT_EQ(bodyOfRadius(NAN), nullptr);
    EXPECT_EQ(bodyOfRadius(INFINITY), nullptr);
    EXPECT_EQ(bodyOfRadius(1.0), nullptr);
}

} // namespace
} // namespace marsview
