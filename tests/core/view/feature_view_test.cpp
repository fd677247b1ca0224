#include "core/view/feature_view.h"

#include <gtest/gtest.h>

#include <numbers>

namespace marsview {
namespace {

Georeference globalMars()
{
    return {1440, 720, GeoTransform::fromTerms({0.0, 0.25, 0.0, 90.0, 0.0, -0.25}).value(),
            Crs::fromText("IAU_2015:49900").value()};
}

GeographicPoint at(double longitude_deg, double latitude_deg)
{
    return {Angle::degrees(longitude_deg), Angle::degrees(latitude_deg)};
}

} // namespace

TEST(FeatureView, SpansTheFeatureInTheDirectionThatIsStretchedMost)
{
    const Georeference map = globalMars();
    const double radius_m = map.crs()->ellipsoid()->equatorial_m;
    // An equirectangular scene is true to scale along meridians, and stretched by 1/cos 60° along
    // the parallel.
    const auto equator = featureExtent(map, at(40.0, 0.0), 1e5);
    ASSERT_TRUE(equator);
    EXPECT_NEAR(equator->across_m, 1e5, 100.0);
    EXPECT_NEAR(equator->center.column, 40.0 / 0.25 - 0.5, 1e-9);
    const auto north = featureExtent(map, at(-10.0, 60.0), 1e5);
    ASSERT_TRUE(north);
    EXPECT_NEAR(north->across_m, 2e5, 500.0);
    // At the seam half of the feature is on the other side of the map.
    const auto seam = featureExtent(map, at(0.1, 0.0), 1e5);
    ASSERT_TRUE(seam);
    EXPECT_NEAR(seam->across_m, 1e5, 100.0);
    const auto pole = featureExtent(map, at(0.0, 90.0), 1e5);
    ASSERT_TRUE(pole);
    EXPECT_LE(pole->across_m, 8e5);
    EXPECT_LT(pole->across_m, radius_m);
}

TEST(FeatureView, HasNoExtentOutsideTheMap)
{
    const Georeference map(40, 30,
                           GeoTransform::fromTerms({10.0, 0.25, 0.0, 20.0, 0.0, -0.25}).value(),
                           Crs::fromText("IAU_2015:49900").value());
    EXPECT_TRUE(featureExtent(map, at(10.01, 19.99), 0.0));
    EXPECT_FALSE(featureExtent(map, at(9.9, 15.0), 0.0));
    EXPECT_FALSE(featureExtent(map, at(200.0, 15.0), 0.0));
    EXPECT_TRUE(featureExtent(map, at(15.0 - 360.0, 15.0), 0.0));
}

TEST(FeatureView, FillsTheShorterSideOfThePicture)
{
    for (const Viewport viewport : {Viewport{1200, 800}, Viewport{500, 900}}) {
        OrbitCamera camera;
        camera.distance_m = distanceShowing(5000.0, 0.5, camera.field_of_view, viewport);
        const auto left = project(camera, viewport, {-2500.0, 0.0, 0.0});
        const auto right = project(camera, viewport, {2500.0, 0.0, 0.0});
        ASSERT_TRUE(left && right);
        EXPECT_NEAR(right->x - left->x, 0.5 * std::min(viewport.width, viewport.height), 1e-6);
    }
}

} // namespace marsview
