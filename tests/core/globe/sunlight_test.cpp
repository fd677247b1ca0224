#include "core/globe/body_camera.h"
#include "core/globe/sunlight.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview::test {
namespace {

constexpr Ellipsoid kMars{3396190.0, 3376200.0};
constexpr Ellipsoid kMoon{1737400.0, 1737400.0};

GeographicPoint at(double longitude_deg, double latitude_deg)
{
    return {.longitude = Angle::degrees(longitude_deg), .latitude = Angle::degrees(latitude_deg)};
}

// The sine of the sun's altitude.
double sunHeight(const Vec3& sun, const GeographicPoint& place, const Ellipsoid& body)
{
    return dot(sun, localAxes(body, place).up);
}

TEST(Sunlight, StandsOverheadAtTheSubsolarPoint)
{
    for (const Ellipsoid& body : {kMars, kMoon}) {
        for (const GeographicPoint& place :
             {at(0, 0), at(226.2, 18.65), at(-40, -72), at(10, 90), at(0, -90)}) {
            const Vec3 sun = directionToSun(place, body);
            EXPECT_NEAR(sunHeight(sun, place, body), 1.0, 1e-12);
        }
    }
    // On a sphere it stands in the line through the center.
    const Vec3 sun = directionToSun(at(30, 0), kMoon);
    EXPECT_NEAR(sun.x, std::sqrt(0.75), 1e-12);
    EXPECT_NEAR(sun.y, 0.5, 1e-12);
    EXPECT_NEAR(sun.z, 0.0, 1e-12);
}

TEST(Sunlight, SetsAQuarterTurnAway)
{
    const Vec3 sun = directionToSun(at(30, 0), kMars);
    for (const double latitude_deg : {-80.0, -10.0, 0.0, 45.0}) {
        EXPECT_NEAR(sunHeight(sun, at(120, latitude_deg), kMars), 0.0, 1e-12);
        EXPECT_NEAR(sunHeight(sun, at(-60, latitude_deg), kMars), 0.0, 1e-12);
        EXPECT_LT(sunHeight(sun, at(-150, latitude_deg), kMars), 0.0);
    }
    EXPECT_NEAR(sunHeight(sun, at(0, 90), kMars), 0.0, 1e-12);
}

// The light of a view becomes that of the body without a change at its target.
TEST(Sunlight, IsSeenFromAPlaceWhereItWasPut)
{
    for (const Ellipsoid& body : {kMars, kMoon}) {
        for (const double azimuth_deg : {315.0, 90.0, 0.0, 200.0}) {
            for (const double altitude_deg : {45.0, 1.0, 90.0}) {
                const GeographicPoint place = at(137.4, -4.6);
                const GeographicPoint below = subsolarPoint(place, Angle::degrees(azimuth_deg),
                                                            Angle::degrees(altitude_deg), body);
                const Vec3 sun = directionToSun(below, body);
                const LocalAxes axes = localAxes(body, place);
                const double altitude = Angle::degrees(altitude_deg).radians();
                const double azimuth = Angle::degrees(azimuth_deg).radians();
                EXPECT_NEAR(dot(sun, axes.up), std::sin(altitude), 1e-12);
                EXPECT_NEAR(dot(sun, axes.east), std::cos(altitude) * std::sin(azimuth), 1e-12);
                EXPECT_NEAR(dot(sun, axes.north), std::cos(altitude) * std::cos(azimuth), 1e-12);
            }
        }
    }
}

} // namespace
} // namespace marsview::test
