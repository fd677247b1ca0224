#include "core/contact/body_below.h"
#include "tests/core/contact/body_maps.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/support/nan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace marsview {
namespace {

constexpr double kRadiusM = 1737400.0; // IAU_2015:30100 is a sphere
constexpr double kHeightM = 100.0;

// A sample a degree, from 10° W to 10° E and 10° N to 10° S, all at the same height.
BodySurface flatPartOfTheMoon()
{
    const test::BodyMap map{"Moon", "IAU_2015:30100", 21, 21, {-10.5, 1.0, 0.0, 10.5, 0.0, -1.0},
                            0.0};
    const auto terrain = test::filledTerrain(21, std::vector<float>(21 * 21, float{kHeightM}));
    JobMonitor monitor;
    const auto mesh = BodyMesh::build(terrain, test::georeferenceOf(map), 1.0, monitor);
    EXPECT_TRUE(mesh) << (mesh ? "" : mesh.error().message);
    return BodySurface(*mesh);
}

Vec3 up(double longitude_deg, double latitude_deg)
{
    const double longitude = Angle::degrees(longitude_deg).radians();
    const double latitude = Angle::degrees(latitude_deg).radians();
    return {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
            std::sin(latitude)};
}

TEST(BodyBelow, MeasuresAlongTheNormalFromAboveAndFromBelow)
{
    const BodySurface surface = flatPartOfTheMoon();
    for (const double height_m : {5000.0, 40.0, -3000.0}) {
        const ScenePoint point = up(3.0, -4.0) * (kRadiusM + height_m);
        const BodyBelow below = belowOn(surface, point);
        EXPECT_NEAR(below.clearance_m, height_m - kHeightM, 1e-6);
        EXPECT_NEAR(below.level_m, kHeightM, 1e-6);
        EXPECT_EQ(below.over, point);
        EXPECT_FALSE(below.is_beside);
    }
    // In the middle of a diagonal, the surface is that of its chord.
    const Vec3 from = up(3.0, -3.0);
    const Vec3 to = up(4.0, -4.0);
    const double chord_m = (kRadiusM + kHeightM) * 0.5 * length(from + to);
    EXPECT_NEAR(clearanceOver(surface, normalized(from + to) * (kRadiusM + 1000.0)),
                kRadiusM + 1000.0 - chord_m, 1e-6);
}

TEST(BodyBelow, LooksForTheNearestBorderBesideTheMap)
{
    const BodySurface surface = flatPartOfTheMoon();
    for (const double height_m : {2000.0, -500.0}) {
        const ScenePoint point = up(11.0, 11.0) * (kRadiusM + height_m);
        EXPECT_TRUE(std::isnan(clearanceOver(surface, point)));
        const BodyBelow below = belowOn(surface, point, kHeightM);
        EXPECT_TRUE(below.is_beside);
        // Both borders lead away from a point beyond their corner. A millionth of a face inward.
        EXPECT_NEAR(length(below.over - up(10.0, 10.0) * (kRadiusM + height_m)), 0.0, 0.05);
        EXPECT_NEAR(below.clearance_m, height_m - kHeightM, 0.05);
        EXPECT_NEAR(below.level_m, kHeightM, 0.05);
    }
}

TEST(BodyBelow, FindsNothingOnTheFarSideOfTheBody)
{
    const BodySurface surface = flatPartOfTheMoon();
    EXPECT_TRUE(std::isnan(clearanceOver(surface, up(180.0, 0.0) * (kRadiusM + 1000.0))));
    const BodyBelow none = belowOn(surface, {kNan, 0.0, 0.0});
    EXPECT_TRUE(std::isnan(none.clearance_m));
    EXPECT_FALSE(none.is_beside);
}

} // namespace
} // namespace marsview
