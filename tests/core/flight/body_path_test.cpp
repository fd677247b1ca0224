// Paths of the camera over a body, against great circles on a sphere.
#include "core/flight/camera_path.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace marsview {
namespace {

constexpr double kPathRadius = 3.39e6;
const Ellipsoid kPathSphere{kPathRadius, kPathRadius};

Vec3 directionOnBody(const GeographicPoint& place)
{
    const double cosine = std::cos(place.latitude.radians());
    return {cosine * std::cos(place.longitude.radians()),
            cosine * std::sin(place.longitude.radians()), std::sin(place.latitude.radians())};
}

double angleOnBody(const Vec3& a, const Vec3& b)
{
    return std::atan2(length(cross(a, b)), dot(a, b));
}

GeographicPoint placeOnBody(double longitude_deg, double latitude_deg)
{
    return {.longitude = Angle::degrees(longitude_deg), .latitude = Angle::degrees(latitude_deg)};
}

BodyCamera anyBodyCamera(test::Random& random)
{
    return {.target = placeOnBody(random.uniform(-180.0, 180.0), random.uniform(-89.0, 89.0)),
            .height_m = random.uniform(-5e3, 2e4),
            .distance_m = std::pow(10.0, random.uniform(4.0, 7.0)),
            .azimuth = Angle::degrees(random.uniform(-180.0, 180.0)),
            .tilt = Angle::degrees(random.uniform(0.0, 80.0))};
}

TEST(BodyPath, ReachesEveryCameraInTurn)
{
    test::Random random(11);
    for (int i = 0; i < 50; ++i) {
        const std::vector<BodyCamera> cameras{anyBodyCamera(random), anyBodyCamera(random),
                                              anyBodyCamera(random)};
        const CameraPath path =
            CameraPath::throughCameras(cameras, FlightPace::SlowAtViews, kPathSphere);
        ASSERT_TRUE(path.isOnBody());
        for (std::size_t k = 0; k < cameras.size(); ++k) {
            const BodyCamera reached = path.bodyCameraAt(path.stops()[k]);
            EXPECT_LT(
                angleOnBody(directionOnBody(reached.target), directionOnBody(cameras[k].target)),
                1e-7);
            EXPECT_NEAR(reached.height_m, cameras[k].height_m, 0.1);
            EXPECT_NEAR(reached.distance_m / cameras[k].distance_m, 1.0, 1e-6);
            EXPECT_NEAR(std::remainder((reached.azimuth - cameras[k].azimuth).degrees(), 360.0),
                        0.0, 1e-4);
            EXPECT_NEAR(reached.tilt.degrees(), cameras[k].tilt.degrees(), 1e-4);
        }
    }
}

TEST(BodyPath, TheTargetFollowsTheGreatCircleAndTheCameraClimbs)
{
    test::Random random(12);
    for (int i = 0; i < 50; ++i) {
        const BodyCamera from = anyBodyCamera(random);
        const BodyCamera to = anyBodyCamera(random);
        const CameraPath path =
            CameraPath::throughCameras({from, to}, FlightPace::Constant, kPathSphere);
        const Vec3 start = directionOnBody(from.target);
        const Vec3 normal = normalized(cross(start, directionOnBody(to.target)));
        const double whole = angleOnBody(start, directionOnBody(to.target));
        double highest_m = 0.0;
        double before = -1e-9;
        for (int k = 0; k <= 200; ++k) {
            const BodyCamera camera = path.bodyCameraAt(k / 200.0);
            const Vec3 here = directionOnBody(camera.target);
            // By less than a pixel of a picture 700 pixels high.
            EXPECT_LT(std::abs(dot(here, normal)) * kPathRadius, 1e-3 * camera.distance_m)
                << i << ", " << k;
            const double way = angleOnBody(start, here);
            EXPECT_GE(way, before - 1e-6);
            before = way;
            highest_m = std::max(highest_m, camera.distance_m);
        }
        EXPECT_NEAR(before, whole, 1e-7);
        EXPECT_GT(highest_m, 0.3 * whole * kPathRadius);
    }
}

TEST(BodyPath, OppositePlacesAreFlownBetweenToo)
{
    const CameraPath path =
        CameraPath::throughCameras({{.target = placeOnBody(20.0, 0.0), .distance_m = 1e6},
                                    {.target = placeOnBody(-160.0, 0.0), .distance_m = 1e6}},
                                   FlightPace::Constant, kPathSphere);
    Vec3 before = directionOnBody(placeOnBody(20.0, 0.0));
    for (int k = 1; k <= 400; ++k) {
        const BodyCamera camera = path.bodyCameraAt(k / 400.0);
        ASSERT_TRUE(isFinite(directionOnBody(camera.target)));
        EXPECT_LT(angleOnBody(before, directionOnBody(camera.target)), 0.05);
        before = directionOnBody(camera.target);
    }
    EXPECT_LT(angleOnBody(before, directionOnBody(placeOnBody(-160.0, 0.0))), 1e-7);
}

TEST(BodyPath, ConstantPaceHasNoJumpsOfTheVelocity)
{
    test::Random random(13);
    std::vector<BodyCamera> cameras;
    for (int i = 0; i < 4; ++i) {
        cameras.push_back(anyBodyCamera(random));
    }
    const CameraPath path = CameraPath::throughCameras(cameras, FlightPace::Constant, kPathSphere);
    constexpr double kStep = 1e-7;
    const auto place = [&](double share) {
        return directionOnBody(path.bodyCameraAt(share).target);
    };
    double fastest = 0.0;
    double jump = 0.0;
    for (double share = 0.001; share < 0.999; share += 0.00037) {
        const Vec3 before = (place(share) - place(share - kStep)) * (1.0 / kStep);
        const Vec3 after = (place(share + kStep) - place(share)) * (1.0 / kStep);
        fastest = std::max({fastest, length(before), length(after)});
        jump = std::max(jump, length(after - before));
    }
    EXPECT_LT(jump, 0.01 * fastest);
}

TEST(BodyPath, NeverGoesBelowTheGround)
{
    test::Random random(14);
    const auto mountains = [](const GeographicPoint& place) {
        return 6000.0 * std::sin(40.0 * place.longitude.radians()) *
               std::cos(60.0 * place.latitude.radians());
    };
    for (int i = 0; i < 10; ++i) {
        std::vector<BodyCamera> cameras;
        for (int k = 0; k < 3; ++k) {
            BodyCamera camera = anyBodyCamera(random);
            camera.target = placeOnBody(random.uniform(170.0, 190.0), random.uniform(-5.0, 5.0));
            camera.distance_m = random.uniform(1e4, 1e5);
            camera.tilt = Angle::degrees(random.uniform(60.0, 84.0));
            cameras.push_back(camera);
        }
        const CameraPath path =
            CameraPath::throughCameras(cameras, FlightPace::Constant, kPathSphere).above(mountains);
        for (int k = 0; k <= 3000; ++k) {
            const BodyCamera camera = path.bodyCameraAt(k / 3000.0);
            const BodyPlace eye = placeOf(poseOf(camera, kPathSphere).eye, kPathSphere);
            EXPECT_GT(eye.height_m, mountains(eye.foot) + camera.distance_m / 50.0)
                << i << ", " << k;
        }
    }
}

TEST(BodyPath, FollowsALineAcrossTheSeamAndOverThePole)
{
    // From 60° N, 179° E over the pole to 60° N, 1° W: straight on, heading north, then south.
    std::vector<ScenePoint> line;
    for (int i = 0; i <= 60; ++i) {
        const double latitude = 60.0 + i;
        line.push_back(directionOnBody(latitude <= 90.0 ? placeOnBody(179.0, latitude)
                                                        : placeOnBody(-1.0, 180.0 - latitude)) *
                       (kPathRadius + 100.0));
    }
    const CameraPath path =
        CameraPath::alongLine(line, {.distance_m = 5e4, .tilt = Angle::degrees(60.0)}, kPathSphere);
    double slowest = 1e9;
    double fastest = 0.0;
    for (int k = 0; k < 1000; ++k) {
        const BodyCamera camera = path.bodyCameraAt(k / 1000.0);
        const Vec3 here = directionOnBody(camera.target);
        const Vec3 next = directionOnBody(path.bodyCameraAt((k + 1) / 1000.0).target);
        const double step = angleOnBody(here, next);
        slowest = std::min(slowest, step);
        fastest = std::max(fastest, step);
        EXPECT_NEAR(camera.height_m, 100.0, 1.0);
        EXPECT_NEAR(camera.distance_m, 5e4, 1e-3);
        if (camera.target.latitude.degrees() < 89.5) {
            const LocalAxes axes = localAxes(kPathSphere, camera.target);
            const double heading =
                std::atan2(dot(next - here, axes.east), dot(next - here, axes.north));
            EXPECT_NEAR(std::remainder(camera.azimuth.radians() - heading, 2.0 * std::numbers::pi),
                        0.0, 0.02)
                << k;
        }
    }
    EXPECT_LT(fastest / slowest, 1.05);
    EXPECT_LT(angleOnBody(directionOnBody(path.bodyCameraAt(1.0).target),
                          directionOnBody(placeOnBody(-1.0, 60.0))),
              1e-7);
}

} // namespace
} // namespace marsview
