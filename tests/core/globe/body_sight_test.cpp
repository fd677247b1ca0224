#include "core/globe/body_camera.h"
#include "core/globe/body_sight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace marsview {
namespace {

constexpr double kRadius = 1.0e6;
const Ellipsoid kSphere{kRadius, kRadius};

// Looks straight down from `distance_m`, with a picture that shows everything below.
CameraPose above(Angle longitude, Angle latitude, double distance_m)
{
    return poseOf({.target = {.longitude = longitude, .latitude = latitude},
                   .distance_m = distance_m,
                   .field_of_view = Angle::degrees(170.0)},
                  kSphere);
}

TEST(BodySight, SeesTheCapWithinTheHorizon)
{
    // Of a sphere, (1 - R / (R + h)) / 2 is in sight.
    for (const double distance_m : {0.25 * kRadius, kRadius, 9.0 * kRadius}) {
        const BodySight sight =
            bodySight(above(Angle::degrees(170.0), Angle::degrees(65.0), distance_m), kSphere,
                      {.width = 500, .height = 500}, 721, 361);
        EXPECT_NEAR(shareOfBody(sight), 0.5 * (1.0 - kRadius / (kRadius + distance_m)), 2e-3);
    }
}

TEST(BodySight, ItsEdgesAreAsFarFromTheMiddleAsTheHorizon)
{
    const double distance_m = 0.5 * kRadius;
    const Angle latitude = Angle::degrees(80.0);
    const BodySight sight = bodySight(above(Angle(), latitude, distance_m), kSphere,
                                      {.width = 500, .height = 500}, 181, 91);
    const double reach = std::acos(kRadius / (kRadius + distance_m));
    const auto edges = edgesOf(sight);
    ASSERT_GT(edges.size(), 100U);
    for (const auto& edge : edges) {
        for (const GeographicPoint& place : edge) {
            const double cosine =
                std::sin(latitude.radians()) * std::sin(place.latitude.radians()) +
                std::cos(latitude.radians()) * std::cos(place.latitude.radians()) *
                    std::cos(place.longitude.radians());
            EXPECT_NEAR(std::acos(cosine), reach, 0.02);
        }
    }
}

TEST(BodySight, ThePictureBoundsIt)
{
    // From low above the equator, half the picture is the slope of the field of view away.
    const double distance_m = 0.01 * kRadius;
    const CameraPose pose = poseOf(
        {.target = {}, .distance_m = distance_m, .field_of_view = Angle::degrees(90.0)}, kSphere);
    const BodySight sight = bodySight(pose, kSphere, {.width = 400, .height = 200}, 36001, 3);
    std::size_t seen = 0;
    for (std::size_t column = 0; column < sight.columns; ++column) {
        seen += sight.margin(column, 1) > 0.0F ? 1U : 0U;
    }
    // The ground falls away: sin θ = 2 (0.01 + 1 - cos θ), so θ = 0.0204, in steps of 0.01°.
    EXPECT_NEAR(static_cast<double>(seen), 2.0 * 0.0204 * 18000.0 / std::numbers::pi, 2.0);
}

TEST(BodySight, ThePlacesAreThoseOfTheEllipsoid)
{
    const Ellipsoid flat{3396190.0, 3376200.0};
    const CameraPose pose =
        poseOf({.target = {.longitude = Angle::degrees(30.0), .latitude = Angle::degrees(60.0)},
                .distance_m = 10.0,
                .field_of_view = Angle::degrees(40.0)},
               flat);
    // Columns of 30° and rows of 30°: one place is the target, 10 m below the eye.
    const BodySight sight = bodySight(pose, flat, {.width = 100, .height = 100}, 13, 7);
    EXPECT_GT(sight.margin(7, 1), 0.9F);
    std::size_t seen = 0;
    for (const float margin : sight.margins) {
        seen += margin > 0.0F ? 1U : 0U;
    }
    EXPECT_EQ(seen, 1U);
}

} // namespace
} // namespace marsview
