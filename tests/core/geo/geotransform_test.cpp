#include "core/geo/geotransform.h"
#include "tests/support/nan.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace marsview {
namespace {

using Terms = GeoTransform::Terms;

TEST(GeoTransform, PlacesPixelCentersHalfAPixelInsideTheCorner)
{
    const auto transform = GeoTransform::fromTerms({100.0, 2.0, 0.0, 50.0, 0.0, -4.0});
    ASSERT_TRUE(transform);
    EXPECT_EQ(transform->toMap({0.0, 0.0}), (MapPoint{101.0, 48.0}));
    EXPECT_EQ(transform->toMap({-0.5, -0.5}), (MapPoint{100.0, 50.0}));
    EXPECT_EQ(transform->toGrid({101.0, 48.0}), (GridPoint{0.0, 0.0}));
}

TEST(GeoTransform, UsesAllSixTerms)
{
    test::Random random;
    for (int i = 0; i < 2000; ++i) {
        Terms t{};
        for (double& term : t) {
            term = random.uniform(-1e4, 1e4);
        }
        const auto transform = GeoTransform::fromTerms(t);
        if (!transform) {
            continue;
        }
        const GridPoint grid{random.uniform(-10.0, 1e5), random.uniform(-10.0, 1e5)};
        const long double pixel = grid.column + 0.5L;
        const long double line = grid.row + 0.5L;
        const MapPoint map = transform->toMap(grid);
        // Three roundings of at most 1e9 each.
        ASSERT_NEAR(map.x, static_cast<double>(t[0] + pixel * t[1] + line * t[2]), 1e-6);
        ASSERT_NEAR(map.y, static_cast<double>(t[3] + pixel * t[4] + line * t[5]), 1e-6);
    }
}

TEST(GeoTransform, RoundTripsWithinABillionthOfASample)
{
    test::Random random;
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
        // A similarity with a shear: any rotation, either handedness, pixels of up to 5 to 1.
        const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
        const double skew = random.uniform(-0.3, 0.3);
        const double width = std::exp(random.uniform(-9.0, 9.0));
        const double height = width * std::exp(random.uniform(-1.6, 1.6));
        const double hand = random.chance(0.5) ? 1.0 : -1.0;
        const bool is_upright = random.chance(0.3);
        const Terms t{random.uniform(-1e5, 1e5) * width,
                      is_upright ? width : width * std::cos(angle),
                      is_upright ? 0.0 : -hand * height * std::sin(angle + skew),
                      random.uniform(-1e5, 1e5) * width,
                      is_upright ? 0.0 : width * std::sin(angle),
                      is_upright ? hand * height : hand * height * std::cos(angle + skew)};
        const auto transform = GeoTransform::fromTerms(t);
        ASSERT_TRUE(transform);
        const GridPoint grid{random.uniform(-1.0, 1e5), random.uniform(-1.0, 1e5)};
        const GridPoint back = transform->toGrid(transform->toMap(grid));
        worst =
            std::max({worst, std::abs(back.column - grid.column), std::abs(back.row - grid.row)});
    }
    std::printf("worst round trip %.3g sample\n", worst);
    EXPECT_LT(worst, 1e-9);
}

TEST(GeoTransform, PixelSizesAreLengthsOfSteps)
{
    const auto transform = GeoTransform::fromTerms({0.0, 3.0, -5.0, 0.0, 4.0, 12.0});
    ASSERT_TRUE(transform);
    EXPECT_EQ(transform->pixelWidth(), 5.0);
    EXPECT_EQ(transform->pixelHeight(), 13.0);
}

TEST(GeoTransform, RefusesTermsThatCannotBeInverted)
{
    constexpr double kInf = std::numeric_limits<double>::infinity();
    const Terms bad[] = {
        {0, 0, 0, 0, 0, 0},          {0, 1, 0, 0, 0, 0},     {0, 0, 0, 0, 0, 1},
        {0, 0, 0, 0, 1, 1},          {0, 1, 2, 0, 2, 4},     {0, 30, 30, 0, 30, 30},
        {0, 1, 1, 0, 1, 1 + 1e-12},  {kNan, 1, 0, 0, 0, -1}, {0, kNan, 0, 0, 0, -1},
        {0, 1, kNan, 0, 0, -1},      {0, 1, 0, kNan, 0, -1}, {0, 1, 0, 0, kNan, -1},
        {0, 1, 0, 0, 0, kNan},       {kInf, 1, 0, 0, 0, -1}, {0, kInf, 0, 0, 0, -1},
        {0, 1, 0, -kInf, 0, -1},     {0, 1, 0, 0, 0, -kInf}, {0, 1e200, 0, 0, 0, 1e200},
        {0, 1e-200, 0, 0, 0, 1e-200}};
    for (const Terms& t : bad) {
        const auto transform = GeoTransform::fromTerms(t);
        ASSERT_FALSE(transform) << t[0] << " " << t[1] << " " << t[2] << " " << t[3] << " " << t[4]
                                << " " << t[5];
        EXPECT_EQ(transform.error().code, ErrorCode::Invalid);
        EXPECT_NE(transform.error().message.find("cannot be inverted"), std::string::npos);
    }
}

TEST(GeoTransform, SmallAndLargePixelsAreNotSingular)
{
    EXPECT_TRUE(GeoTransform::fromTerms({0, 1e-9, 0, 0, 0, -1e-9}));
    EXPECT_TRUE(GeoTransform::fromTerms({0, 1e9, 0, 0, 0, 1e9}));
    EXPECT_TRUE(GeoTransform::fromTerms({0, 1e-6, 0, 0, 0, -1e6}));
    EXPECT_TRUE(GeoTransform::fromTerms({0, 0, 30, 0, 30, 0})); // rows run east
}

} // namespace
} // namespace marsview
