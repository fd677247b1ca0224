#include "core/globe/body_camera.h"
#include "core/globe/body_view.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

const Ellipsoid kMars{3396190.0, 3376200.0};
constexpr Viewport kPicture{.width = 900, .height = 600};

// The ray from the eye to a point of the ellipsoid, brought to a sphere, enters that sphere at the
// point or before it.
bool isBehindEllipsoid(const ScenePoint& point, const ScenePoint& eye)
{
    const double scale = kMars.equatorial_m / kMars.polar_m;
    const Vec3 from{eye.x, eye.y, eye.z * scale};
    const Vec3 to{point.x, point.y, point.z * scale};
    const Vec3 way = to - from;
    const double a = dot(way, way);
    const double b = dot(from, way);
    const double c = dot(from, from) - kMars.equatorial_m * kMars.equatorial_m;
    const double root = b * b - a * c;
    return root > 0.0 && (-b - std::sqrt(root)) / a < 1.0 - 1e-9;
}

BodyCamera randomCamera(test::Random& random)
{
    return {.target = {.longitude = Angle::degrees(random.uniform(-180.0, 180.0)),
                       .latitude = Angle::degrees(random.uniform(-90.0, 90.0))},
            .distance_m = std::pow(10.0, random.uniform(1.0, 7.5)),
            .azimuth = Angle::degrees(random.uniform(-180.0, 180.0)),
            .tilt = Angle::degrees(random.uniform(0.0, 80.0))};
}

TEST(BodyView, TheHorizonHidesWhatARayToItMeetsLater)
{
    test::Random random(7);
    int hidden = 0;
    for (int i = 0; i < 2000; ++i) {
        const BodyView view(poseOf(randomCamera(random), kMars), kPicture, kMars, {});
        const ScenePoint point = targetOf(randomCamera(random), kMars);
        EXPECT_EQ(view.isBehindHorizon(point), isBehindEllipsoid(point, view.pose().eye)) << i;
        hidden += view.isBehindHorizon(point) ? 1 : 0;
    }
    EXPECT_GT(hidden, 500);
    EXPECT_LT(hidden, 1990);
}

TEST(BodyView, NoLineIsOutOfSightWithAPointInThePicture)
{
    test::Random random(8);
    int seen = 0;
    int left_out = 0;
    for (int i = 0; i < 1500; ++i) {
        const BodyCamera camera = randomCamera(random);
        const BodyView view(poseOf(camera, kMars), kPicture, kMars,
                            {.lowest_m = -8000.0, .highest_m = 21000.0, .exaggeration = 5.0});
        // Near the target, over terrain with a slope of 45° at most.
        const double away_deg =
            random.chance(0.5) ? 0.0 : std::pow(10.0, random.uniform(-3.0, 1.5));
        const auto place = [&](double share, double reach_deg) {
            return GeographicPoint{
                .longitude = camera.target.longitude + Angle::degrees(away_deg + reach_deg * share),
                .latitude = Angle::degrees(
                    std::clamp(camera.target.latitude.degrees() + 0.7 * reach_deg * (share - 0.3),
                               -90.0, 90.0))};
        };
        const double reach_deg = std::pow(10.0, random.uniform(-4.0, 1.0));
        const double step_m = reach_deg * 1e3;
        const auto point = [&](double share) {
            const double height_m =
                std::min(step_m, 8000.0) * std::sin(3.0 * share) * view.relief().exaggeration;
            return targetOf({.target = place(share, reach_deg), .height_m = height_m}, kMars);
        };
        bool is_seen = false;
        double length_m = 0.0;
        for (int k = 0; k <= 20; ++k) {
            const auto pixel = project(view.pose(), kPicture, point(k / 20.0));
            is_seen = is_seen ||
                      (pixel && pixel->x > 0.0 && pixel->x < kPicture.width && pixel->y > 0.0 &&
                       pixel->y < kPicture.height && !view.isBehindHorizon(point(k / 20.0)));
            length_m += k > 0 ? length(point(k / 20.0) - point((k - 1) / 20.0)) : 0.0;
        }
        const bool is_out = view.isOutOfSight(point(0.0), point(1.0), length_m);
        EXPECT_FALSE(is_seen && is_out) << i;
        seen += is_seen ? 1 : 0;
        left_out += is_out ? 1 : 0;
    }
    EXPECT_GT(seen, 500);
    EXPECT_GT(left_out, 100);
}

} // namespace
} // namespace marsview
