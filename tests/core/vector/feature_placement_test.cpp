#include "core/vector/feature_placement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace marsview::test {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

Georeference georeference(const char* crs,
                          std::size_t columns,
                          std::size_t rows,
                          const GeoTransform::Terms& terms)
{
    return {columns, rows, *GeoTransform::fromTerms(terms), *Crs::fromText(crs)};
}

// One sample per degree, from 0° to 360°.
Georeference globe()
{
    return georeference("IAU_2015:49900", 360, 180, {0.0, 1.0, 0.0, 90.0, 0.0, -1.0});
}

FeaturePart line(std::initializer_list<MapPoint> points)
{
    return {.points = points};
}

} // namespace

TEST(FeaturePlacement, LongitudesLieWhereAPolarMapHasThem)
{
    // North polar stereographic on a sphere of 3 396 190 m: the closed form (Snyder 1987, eq. 21-5
    // to 21-7) has the distance 2 R tan(45° - latitude/2) from the pole.
    constexpr double kRadius = 3396190.0;
    const Georeference map = georeference("+proj=stere +lat_0=90 +lon_0=0 +k=1 +R=3396190 +units=m",
                                          1000, 1000, {-1e6, 2000.0, 0.0, 1e6, 0.0, -2000.0});
    const FeaturePlacement placement(*Crs::fromText("+proj=longlat +R=3396190"), map);
    for (const MapPoint& at : {MapPoint{0.0, 80.0}, MapPoint{90.0, 85.5}, MapPoint{-137.0, 76.0}}) {
        const double rho = 2.0 * kRadius * std::tan((45.0 - 0.5 * at.y) * kRadians);
        const auto place = placement.place(at);
        ASSERT_TRUE(place);
        EXPECT_NEAR(place->x, rho * std::sin(at.x * kRadians), 1e-3); // the center is the pole
        EXPECT_NEAR(place->y, -rho * std::cos(at.x * kRadians), 1e-3);
    }
}

TEST(FeaturePlacement, AParallelIsRoundOnAPolarMap)
{
    constexpr double kRadius = 3396190.0;
    const Georeference map = georeference("+proj=stere +lat_0=90 +lon_0=0 +k=1 +R=3396190 +units=m",
                                          1000, 1000, {-1e6, 2000.0, 0.0, 1e6, 0.0, -2000.0});
    PlaneFeatures features;
    FeaturePlacement(*Crs::fromText("+proj=longlat +R=3396190"), map)
        .add(7, FeatureShape::Line, {line({{-60.0, 80.0}, {60.0, 80.0}})}, features);
    ASSERT_EQ(features.parts.size(), 1U);
    EXPECT_EQ(features.parts[0].feature, 7U);
    ASSERT_GT(features.points.size(), 8U);
    // Nothing but its ends are vertices.
    std::vector<bool> is_course(features.points.size(), true);
    is_course.front() = is_course.back() = false;
    EXPECT_EQ(features.is_course, is_course);
    const double rho = 2.0 * kRadius * std::tan(5.0 * kRadians);
    for (std::size_t i = 0; i + 1 < features.points.size(); ++i) {
        const PlanePoint& a = features.points[i];
        const PlanePoint& b = features.points[i + 1];
        EXPECT_NEAR(std::hypot(a.x, a.y), rho, 1e-3);
        EXPECT_NEAR(std::hypot(0.5 * (a.x + b.x), 0.5 * (a.y + b.y)), rho, 1100.0)
            << "half a sample, and a little";
    }
}

TEST(FeaturePlacement, LongitudesOfAnyTurnLieOnTheMap)
{
    const FeaturePlacement placement(*Crs::fromText("IAU_2015:49900"), globe());
    const auto place = placement.place({190.0, 10.0});
    const auto same = placement.place({-170.0, 10.0});
    ASSERT_TRUE(place && same);
    EXPECT_NEAR(place->x, same->x, 1e-6);
    EXPECT_NEAR(place->y, same->y, 1e-6);
}

TEST(FeaturePlacement, ALineAcrossTheSeamContinuesOnTheOtherSide)
{
    PlaneFeatures features;
    const FeaturePlacement placement(*Crs::fromText("IAU_2015:49900"), globe());
    placement.add(1, FeatureShape::Line, {line({{350.0, 0.0}, {10.0, 0.0}})}, features);
    ASSERT_EQ(features.parts.size(), 2U);
    ASSERT_EQ(features.points.size(), 4U);
    const double degree_m = (placement.place({101.0, 0.0})->x - placement.place({100.0, 0.0})->x);
    const double edge = placement.place({180.0, 0.0})->x;
    EXPECT_NEAR(features.points[0].x, edge + 170.0 * degree_m, 1.0);
    EXPECT_NEAR(features.points[1].x, edge + 190.0 * degree_m, 1.0) << "beyond the seam";
    EXPECT_NEAR(features.points[2].x, edge - 190.0 * degree_m, 1.0) << "before it";
    EXPECT_NEAR(features.points[3].x, edge - 170.0 * degree_m, 1.0);
}

TEST(FeaturePlacement, APolygonStaysARingUnlessItIsCut)
{
    PlaneFeatures features;
    const FeaturePlacement placement(*Crs::fromText("IAU_2015:49900"), globe());
    placement.add(1, FeatureShape::Polygon,
                  {line({{10.0, 0.0}, {20.0, 0.0}, {20.0, 10.0}, {10.0, 0.0}})}, features);
    placement.add(2, FeatureShape::Polygon,
                  {line({{350.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {350.0, 0.0}})}, features);
    ASSERT_GT(features.parts.size(), 2U);
    EXPECT_EQ(features.parts[0].shape, PlaneShape::Ring);
    for (std::size_t i = 1; i < features.parts.size(); ++i) {
        EXPECT_EQ(features.parts[i].shape, PlaneShape::Line);
    }
}

} // namespace marsview::test
