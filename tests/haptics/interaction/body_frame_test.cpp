#include "core/body/body_positions.h"
#include "haptics/interaction/body_frame.h"
#include "tests/core/contact/body_maps.h"
#include "tests/core/contact/contact_terrain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace marsview {
namespace {

constexpr double kBallRadiusM = 1e6;
constexpr double kBallElevationM = 2000.0;
// With the middle away from the origin.
constexpr WorkspaceBox kWideReach{{-0.10, -0.06, -0.02}, {0.08, 0.05, 0.12}};

struct Ball {
    std::shared_ptr<const Georeference> georeference;
    std::shared_ptr<const BodyMesh> mesh;

    // A grid of longitudes and latitudes on a sphere; all its samples have the same elevation.
    Ball(std::size_t columns, std::size_t rows, const GeoTransform::Terms& terms)
    {
        const test::BodyMap map{"Ball", "+proj=longlat +R=1000000 +no_defs", columns, rows, terms,
                                0.0};
        JobMonitor monitor;
        georeference = std::make_shared<const Georeference>(test::georeferenceOf(map));
        const auto heights = test::filledTerrain(
            columns, std::vector<float>(columns * rows, static_cast<float>(kBallElevationM)));
        mesh = BodyMesh::build(heights, *georeference, 1.0, monitor).value();
    }
};

Vec3 radial(double longitude_deg, double latitude_deg)
{
    const double longitude = Angle::degrees(longitude_deg).radians();
    const double latitude = Angle::degrees(latitude_deg).radians();
    return {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
            std::sin(latitude)};
}

WorkspacePoint middleOf(const WorkspaceBox& box)
{
    return box.low + (box.high - box.low) * 0.5;
}

// Cells of 5°: the samples of the half that faces up are at 2.5°, 7.5° … 87.5° from the middle.
TEST(BodyFrame, TheReachCoversTheHalfOfABallThatFacesUp)
{
    const Ball ball(72, 36, {0, 5, 0, 90, 0, -5});
    const WorkspaceFrame frame = frameForBodyMap(ball.mesh, *ball.georeference, kWideReach);
    EXPECT_NEAR(length(frame.body_axes->z - radial(180.0, 0.0)), 0.0, 1e-12);
    EXPECT_NEAR(length(frame.body_axes->y - Vec3{0.0, 0.0, 1.0}), 0.0, 1e-12);
    const double radius = kBallRadiusM + kBallElevationM;
    const double near = std::cos(Angle::degrees(2.5).radians());
    const double far = std::cos(Angle::degrees(87.5).radians());
    const double across_m = 2.0 * radius * std::sin(Angle::degrees(87.5).radians());
    EXPECT_NEAR(frame.scene_per_meter / (across_m / 0.11), 1.0, 1e-9); // the narrowest is 110 mm
    const double middle_m = 0.5 * radius * (near * near + far * far);
    EXPECT_NEAR(length(frame.toScene(middleOf(kWideReach)) - radial(180.0, 0.0) * middle_m), 0.0,
                1e-6 * radius);
}

TEST(BodyFrame, TheReachCoversAllOfALocalMap)
{
    // From 40° to 50° east and 22° to 26° north.
    const Ball ball(20, 8, {40, 0.5, 0, 26, 0, -0.5});
    const WorkspaceFrame frame = frameForBodyMap(ball.mesh, *ball.georeference, kWideReach);
    EXPECT_NEAR(length(frame.body_axes->z - radial(45.0, 24.0)), 0.0, 1e-12);
    const double radius = kBallRadiusM + kBallElevationM;
    // The southern corners are the farthest apart, and the lowest: 4.75° of longitude at 22.25°.
    const double half_m = radius * std::cos(Angle::degrees(22.25).radians()) *
                          std::sin(Angle::degrees(4.75).radians());
    EXPECT_NEAR(frame.scene_per_meter / (2.0 * half_m / 0.18), 1.0, 1e-9);
    const WorkspacePoint west = frame.toWorkspace(radial(40.25, 22.25) * radius);
    const WorkspacePoint east = frame.toWorkspace(radial(49.75, 22.25) * radius);
    EXPECT_NEAR(west.x, kWideReach.low.x, 1e-9);
    EXPECT_NEAR(east.x, kWideReach.high.x, 1e-9);
    // The highest samples are those next to the middle.
    const double high = frame.toWorkspace(radial(45.25, 24.25) * radius).z;
    EXPECT_NEAR(0.5 * (west.z + high), middleOf(kWideReach).z, 1e-9);
}

TEST(BodyFrame, OfAGivenWidthTheTerrainInTheMiddleIsAtTheCenterOfTheReach)
{
    const Ball ball(20, 8, {40, 0.5, 0, 26, 0, -0.5});
    const WorkspaceFrame frame = frameForBodyMap(ball.mesh, *ball.georeference, kWideReach, 36e3);
    EXPECT_NEAR(frame.scene_per_meter, 36e3 / 0.18, 1e-6);
    // In the middle of a cell of half a degree the terrain is below the sphere by the sagitta of
    // its diagonal.
    const double half_rad = Angle::degrees(0.25).radians();
    const double sagitta_m = 0.5 * (kBallRadiusM + kBallElevationM) * half_rad * half_rad *
                             (1.0 + std::pow(std::cos(Angle::degrees(24.0).radians()), 2));
    const ScenePoint terrain = radial(45.0, 24.0) * (kBallRadiusM + kBallElevationM - sagitta_m);
    EXPECT_NEAR(length(frame.toScene(middleOf(kWideReach)) - terrain), 0.0, 0.5);
}

} // namespace
} // namespace marsview
