#include "core/globe/body_camera.h"
#include "core/globe/body_sight.h"
#include "core/globe/polar_plane.h"
#include "tests/support/random.h"

#include <GeographicLib/PolarStereographic.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace marsview {
namespace {

constexpr double kRadius = 1.0e6;
const Ellipsoid kSphere{kRadius, kRadius};

GeographicPoint placeOf(double longitude_deg, double latitude_deg)
{
    return {.longitude = Angle::degrees(longitude_deg), .latitude = Angle::degrees(latitude_deg)};
}

CameraPose lookingAt(const GeographicPoint& place, double distance_m)
{
    return poseOf({.target = place,
                   .distance_m = distance_m,
                   .azimuth = Angle::degrees(20.0),
                   .tilt = Angle::degrees(35.0)},
                  kSphere);
}

} // namespace

// PROJ 9: cct +proj=stere +lat_0=±90 +R=1. The edge, 50°, is at 0.727940469.
TEST(PolarPlane, HasTheCoordinatesOfProj)
{
    struct Known {
        BodyOverview overview;
        double longitude_deg;
        double latitude_deg;
        double x;
        double y;
    };
    constexpr double kEdge = 0.727940469;
    for (const Known& known :
         {Known{BodyOverview::NorthPole, 0.0, 90.0, 0.0, 0.0},
          Known{BodyOverview::NorthPole, 0.0, 50.0, 0.0, -0.727940469},
          Known{BodyOverview::NorthPole, 90.0, 60.0, 0.535898385, 0.0},
          Known{BodyOverview::NorthPole, -30.0, 75.5, -0.127216068, -0.220344693},
          Known{BodyOverview::NorthPole, 180.0, 80.0, 0.0, 0.174977327},
          Known{BodyOverview::SouthPole, 0.0, -50.0, 0.0, 0.727940469},
          Known{BodyOverview::SouthPole, 90.0, -60.0, 0.535898385, 0.0},
          Known{BodyOverview::SouthPole, -30.0, -75.5, -0.127216068, 0.220344693}}) {
        const PolarPlane plane(known.overview);
        const PolarPoint point = plane.at(placeOf(known.longitude_deg, known.latitude_deg));
        EXPECT_NEAR(point.x, known.x / kEdge, 3e-9) << known.longitude_deg;
        EXPECT_NEAR(point.y, known.y / kEdge, 3e-9) << known.longitude_deg;
    }
    EXPECT_NEAR(PolarPlane::unitAtPole(), kEdge, 1e-9);
}

TEST(PolarPlane, IsThePolarStereographicProjectionOfASphere)
{
    const GeographicLib::PolarStereographic truth(1.0, 0.0, 1.0);
    test::Random random;
    for (const bool is_north : {true, false}) {
        const PolarPlane plane(is_north ? BodyOverview::NorthPole : BodyOverview::SouthPole);
        for (int i = 0; i < 200; ++i) {
            const double longitude_deg = random.uniform(-180.0, 180.0);
            const double latitude_deg = (is_north ? 1.0 : -1.0) * random.uniform(-20.0, 90.0);
            double x = 0.0;
            double y = 0.0;
            truth.Forward(is_north, latitude_deg, longitude_deg, x, y);
            const PolarPoint point = plane.at(placeOf(longitude_deg, latitude_deg));
            EXPECT_NEAR(point.x * PolarPlane::unitAtPole(), x, 1e-12);
            EXPECT_NEAR(point.y * PolarPlane::unitAtPole(), y, 1e-12);
            const GeographicPoint back = plane.placeAt(point);
            EXPECT_NEAR(back.latitude.degrees(), latitude_deg, 1e-11);
            EXPECT_NEAR(std::remainder(back.longitude.degrees() - longitude_deg, 360.0), 0.0, 1e-9);
        }
    }
}

// A small step along an azimuth goes along its heading.
TEST(PolarPlane, HeadingsAreThoseOfSteps)
{
    test::Random random;
    for (const BodyOverview overview : {BodyOverview::NorthPole, BodyOverview::SouthPole}) {
        const PolarPlane plane(overview);
        for (int i = 0; i < 100; ++i) {
            const double latitude_deg = (plane.isNorth() ? 1.0 : -1.0) * random.uniform(50.0, 89.0);
            const GeographicPoint from = placeOf(random.uniform(-180.0, 180.0), latitude_deg);
            const Angle azimuth = Angle::degrees(random.uniform(-180.0, 180.0));
            constexpr double kStep = 1e-6;
            const GeographicPoint to{
                .longitude = from.longitude + Angle::radians(kStep * std::sin(azimuth.radians()) /
                                                             std::cos(from.latitude.radians())),
                .latitude = from.latitude + Angle::radians(kStep * std::cos(azimuth.radians()))};
            const PolarPoint a = plane.at(from);
            const PolarPoint b = plane.at(to);
            const double heading_deg = Angle::radians(std::atan2(b.x - a.x, b.y - a.y)).degrees();
            EXPECT_NEAR(std::remainder(
                            plane.heading(azimuth, from.longitude).degrees() - heading_deg, 360.0),
                        0.0, 0.01);
            const Angle heading = plane.heading(azimuth, from.longitude);
            EXPECT_NEAR(plane.azimuth(heading, from.longitude).degrees(), azimuth.degrees(), 1e-9);
        }
    }
}

TEST(PolarPlane, TheOverviewChangesOnlyBeyondWhereItChangedBefore)
{
    using enum BodyOverview;
    const auto next = [](double latitude_deg, BodyOverview shown) {
        return overviewFor(Angle::degrees(latitude_deg), shown);
    };
    for (const double side : {1.0, -1.0}) {
        const BodyOverview pole = side > 0.0 ? NorthPole : SouthPole;
        const BodyOverview other = side > 0.0 ? SouthPole : NorthPole;
        EXPECT_EQ(next(side * 0.0, Whole), Whole);
        EXPECT_EQ(next(side * 69.9, Whole), Whole);
        EXPECT_EQ(next(side * 70.1, Whole), pole);
        EXPECT_EQ(next(side * 90.0, Whole), pole);
        EXPECT_EQ(next(side * 60.1, pole), pole);
        EXPECT_EQ(next(side * 59.9, pole), Whole);
        EXPECT_EQ(next(side * 65.0, other), Whole); // flown over the equator
        EXPECT_EQ(next(side * 85.0, other), pole);
    }
}

TEST(PolarPlane, TheLinesAroundThePictureEncloseItsTarget)
{
    for (const GeographicPoint& target :
         {placeOf(30.0, 83.0), placeOf(-170.0, 90.0), placeOf(100.0, 71.0)}) {
        for (const BodyOverview overview : {BodyOverview::NorthPole, BodyOverview::SouthPole}) {
            const PolarPlane plane(overview);
            const GeographicPoint place{
                .longitude = target.longitude,
                .latitude =
                    plane.isNorth() ? target.latitude : Angle::degrees(-target.latitude.degrees())};
            const BodySight sight = bodySight(lookingAt(place, 0.3 * kRadius), kSphere,
                                              {.width = 400, .height = 300}, plane, 121);
            const PolarPoint at = plane.at(place);
            int crossings = 0; // of a line from the target to the right
            for (const std::array<GeographicPoint, 2>& edge : edgesOf(sight)) {
                const PolarPoint a = plane.at(edge[0]);
                const PolarPoint b = plane.at(edge[1]);
                if ((a.y > at.y) != (b.y > at.y)) {
                    const double x = a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x);
                    crossings += x > at.x ? 1 : 0;
                }
            }
            EXPECT_EQ(crossings % 2, 1) << target.latitude.degrees();
            EXPECT_GT(shareOfBody(sight), 0.0);
            EXPECT_LT(shareOfBody(sight), 0.6);
        }
    }
}

// Of the disc, which is 1 - sin 50° of a hemisphere: the cap within the horizon.
TEST(PolarPlane, TheShareInSightIsThatOfTheDisc)
{
    const double distance_m = 0.05 * kRadius;
    const CameraPose pose = poseOf({.target = placeOf(0.0, 90.0),
                                    .distance_m = distance_m,
                                    .field_of_view = Angle::degrees(170.0)},
                                   kSphere);
    const BodySight sight = bodySight(pose, kSphere, {.width = 500, .height = 500},
                                      PolarPlane(BodyOverview::NorthPole), 401);
    const double cap = 1.0 - kRadius / (kRadius + distance_m);
    const double disc = 1.0 - std::sin(PolarPlane::kEdge.radians());
    EXPECT_NEAR(shareOfBody(sight), cap / disc, 3e-3);
}

} // namespace marsview
