#include "core/globe/body_camera.h"
#include "core/globe/body_navigation.h"
#include "tests/core/contact/body_maps.h"
#include "tests/support/random.h"

#include <GeographicLib/Geocentric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace marsview {
namespace {

const std::array<Ellipsoid, 3> kBodies{Ellipsoid{3396190.0, 3376200.0},
                                       Ellipsoid{6378137.0, 6356752.314245},
                                       Ellipsoid{1737400.0, 1737400.0}};

BodyCamera randomCamera(test::Random& random, const Ellipsoid& body)
{
    return {.target = {.longitude = Angle::degrees(random.uniform(-180.0, 180.0)),
                       .latitude = Angle::degrees(random.uniform(-90.0, 90.0))},
            .height_m = random.uniform(-8000.0, 20000.0),
            .distance_m = body.equatorial_m * std::pow(10.0, random.uniform(-6.0, 0.7)),
            .azimuth = Angle::degrees(random.uniform(-180.0, 180.0)),
            .tilt = Angle::degrees(random.uniform(0.0, 85.0))};
}

// GeographicLib goes from longitude, latitude and height to the point.
TEST(BodyCamera, PlacesOfPointsAreThoseThatCartConvertStartsFrom)
{
    test::Random random(31);
    for (const Ellipsoid& body : kBodies) {
        const GeographicLib::Geocentric frame(body.equatorial_m, body.flattening());
        const double axes = body.polar_m / body.equatorial_m;
        for (int i = 0; i < 2000; ++i) {
            const double latitude_deg = random.uniform(-90.0, 90.0);
            const double longitude_deg = random.uniform(-180.0, 180.0);
            const double height_m = random.uniform(-1e4, 1e7);
            Vec3 point;
            frame.Forward(latitude_deg, longitude_deg, height_m, point.x, point.y, point.z);
            const BodyPlace place = placeOf(point, body);
            const double graphic_deg =
                std::atan2(std::sin(place.foot.latitude.radians()),
                           axes * axes * std::cos(place.foot.latitude.radians())) *
                180.0 / std::numbers::pi;
            EXPECT_NEAR(graphic_deg, latitude_deg, 1e-11);
            EXPECT_NEAR(std::remainder(place.foot.longitude.degrees() - longitude_deg, 360.0), 0.0,
                        1e-11);
            EXPECT_NEAR(place.height_m, height_m, 1e-8);
        }
    }
}

TEST(BodyCamera, TheTargetIsInTheMiddleWithNorthUpAtTheHeading)
{
    test::Random random(32);
    constexpr Viewport kViewport{800, 600};
    for (const Ellipsoid& body : kBodies) {
        for (int i = 0; i < 2000; ++i) {
            BodyCamera camera = randomCamera(random, body);
            const CameraPose pose = poseOf(camera, body);
            const ScenePoint target = targetOf(camera, body);
            EXPECT_NEAR(length(pose.eye - target), camera.distance_m, 1e-8 * camera.distance_m);
            const auto middle = project(pose, kViewport, target);
            ASSERT_TRUE(middle);
            EXPECT_NEAR(middle->x, 400.0, 1e-6 * 800.0);
            EXPECT_NEAR(middle->y, 300.0, 1e-6 * 600.0);
            EXPECT_NEAR(dot(pose.axes.right, pose.axes.up), 0.0, 1e-12);
            EXPECT_NEAR(length(cross(pose.axes.right, pose.axes.up) + pose.axes.forward), 0.0,
                        1e-12);
            // The horizon is level, and a step to the heading goes up in the picture.
            const LocalAxes local = localAxes(body, camera.target);
            EXPECT_NEAR(dot(pose.axes.right, local.up), 0.0, 1e-12);
            const Vec3 heading = local.north * std::cos(camera.azimuth.radians()) +
                                 local.east * std::sin(camera.azimuth.radians());
            EXPECT_NEAR(dot(heading, pose.axes.right), 0.0, 1e-12);
            EXPECT_GT(dot(heading, pose.axes.up), 0.0);
        }
    }
}

TEST(BodyCamera, TheClipRangeHasEveryPointThatTheHorizonDoesNotHide)
{
    test::Random random(33);
    for (const Ellipsoid& body : kBodies) {
        for (int i = 0; i < 300; ++i) {
            BodyCamera camera = randomCamera(random, body);
            camera.height_m = 20000.0; // above all terrain
            const CameraPose pose = poseOf(camera, body);
            const ClipRange clip = bodyClipRange(pose, body, -8000.0, 20000.0);
            EXPECT_GT(clip.near_m, 0.0);
            EXPECT_GT(clip.far_m, clip.near_m);
            for (int j = 0; j < 300; ++j) {
                BodyCamera there = randomCamera(random, body);
                const ScenePoint p = targetOf(there, body);
                const Vec3 way = p - pose.eye;
                // The way's nearest point to the center, on a sphere inside the body.
                const double share = std::clamp(-dot(pose.eye, way) / dot(way, way), 0.0, 1.0);
                const bool is_hidden = length(pose.eye + way * share) <
                                       std::min(body.polar_m, body.equatorial_m) - 8000.0;
                const double depth = dot(way, pose.axes.forward);
                if (!is_hidden && depth > 0.6 * length(way)) {
                    EXPECT_LT(depth, clip.far_m);
                    EXPECT_GT(depth, std::min(clip.near_m, 0.01 * camera.distance_m));
                }
            }
        }
    }
}

std::shared_ptr<const BodyGrid> gridOf(const test::BodyMap& map)
{
    JobMonitor monitor;
    return BodyGrid::make(test::georeferenceOf(map), monitor).value();
}

// Mountains as steep as 45° whose height is known in closed form everywhere.
double mountains(const GeographicPoint& place)
{
    return 4000.0 * std::sin(40.0 * place.longitude.radians()) *
               std::cos(30.0 * place.latitude.radians()) +
           3000.0;
}

// The first part of what a hundred thousand inputs must never do.
TEST(BodyNavigation, TheEyeIsNeverUnderTheTerrainAndTheTargetNeverFarFromIt)
{
    test::Random random(34);
    for (const test::BodyMap& map : test::bodyMaps()) {
        const auto grid = gridOf(map);
        const BodyLimits limits = bodyLimits(*grid, -1000.0, 7000.0);
        for (int i = 0; i < 2000; ++i) {
            BodyCamera wild = randomCamera(random, limits.ellipsoid);
            wild.tilt = Angle::degrees(random.uniform(-90.0, 180.0));
            wild.azimuth = Angle::degrees(random.uniform(-2000.0, 2000.0));
            wild.height_m = random.uniform(-1e7, 1e7);
            wild.distance_m *= std::pow(10.0, random.uniform(-6.0, 6.0));
            const BodyCamera camera = constrained(wild, limits, mountains);
            const CameraPose pose = poseOf(camera, limits.ellipsoid);
            ASSERT_TRUE(isFinite(pose.eye));
            const BodyPlace eye = placeOf(pose.eye, limits.ellipsoid);
            EXPECT_GT(eye.height_m, mountains(eye.foot) + 0.0199 * camera.distance_m)
                << map.name << ", input " << i;
            EXPECT_GE(camera.distance_m, limits.distance_min_m);
            EXPECT_LE(camera.distance_m, limits.distance_max_m);
            EXPECT_GE(camera.height_m, -1000.0);
            EXPECT_LE(camera.height_m, 7000.0);
            EXPECT_GE(camera.tilt.degrees(), 0.0);
            EXPECT_LE(camera.tilt.degrees(), 85.0);
            EXPECT_EQ(constrained(camera, limits, mountains), camera) << map.name << ' ' << i;
        }
    }
}

TEST(BodyNavigation, HomeShowsEverySampleOfAMapAndTheWholeBall)
{
    for (const test::BodyMap& map : test::bodyMaps()) {
        const auto grid = gridOf(map);
        const BodyLimits limits = bodyLimits(*grid, 0.0, 0.0);
        for (const Viewport viewport : {Viewport{1280, 800}, Viewport{400, 900}}) {
            const BodyCamera home = homeCamera(limits, placesOver(*grid, 0.0, 0.0), viewport);
            EXPECT_LE(home.distance_m, limits.distance_max_m) << map.name;
            const CameraPose pose = poseOf(home, limits.ellipsoid);
            double farthest = 0.0; // from the middle of the picture, 1 at its edge
            for (std::size_t row = 0; row < grid->rows(); ++row) {
                for (std::size_t column = 0; column < grid->columns(); ++column) {
                    const auto pixel = project(pose, viewport, grid->at(column, row, 0.0));
                    ASSERT_TRUE(pixel);
                    farthest = std::max({farthest, std::abs(2.0 * pixel->x / viewport.width - 1.0),
                                         std::abs(2.0 * pixel->y / viewport.height - 1.0)});
                }
            }
            EXPECT_LE(farthest, 1.0) << map.name;
            // A map that is not seen as a ball fills the picture but for the margin.
            EXPECT_GE(farthest, isBall(limits.area) ? 0.45 : 0.94) << map.name;
        }
    }
}

// Where a ray through a point of the picture's upright middle line, 1 at its upper edge, meets the
// sphere.
bool seesGround(const BodyCamera& camera, const Ellipsoid& sphere, double height)
{
    const CameraPose pose = poseOf(camera, sphere);
    const double slope = height * std::tan(camera.field_of_view.radians() / 2.0);
    const Vec3 way = pose.axes.forward + pose.axes.up * slope;
    const double b = dot(pose.eye, way);
    const double c = dot(pose.eye, pose.eye) - sphere.equatorial_m * sphere.equatorial_m;
    return b * b >= dot(way, way) * c;
}

TEST(BodyNavigation, GroundAheadKeepsTheHorizonOutOfTheMiddleOfThePicture)
{
    const Ellipsoid sphere{3.39e6, 3.39e6};
    BodyCamera camera{.target = {.longitude = Angle::degrees(266.0), .latitude = Angle()},
                      .distance_m = 5.6e6,
                      .azimuth = Angle::degrees(-28.0),
                      .tilt = Angle::degrees(52.0)};
    EXPECT_FALSE(seesGround(camera, sphere, 0.5));
    const BodyCamera over = withGroundAhead(camera, sphere);
    EXPECT_TRUE(seesGround(over, sphere, 0.79));
    EXPECT_FALSE(seesGround(over, sphere, 0.81)) << "tilted as much as that allows";
    EXPECT_EQ(over.distance_m, camera.distance_m);
    EXPECT_EQ(over.azimuth, camera.azimuth);
    camera.distance_m = 1e5;
    EXPECT_EQ(withGroundAhead(camera, sphere), camera) << "the ground is as good as flat";
    camera.distance_m = 3e7;
    EXPECT_NEAR(withGroundAhead(camera, sphere).tilt.degrees(), 0.0, 1e-3) << "all of the body";
}

} // namespace
} // namespace marsview
