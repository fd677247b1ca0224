#include "core/geo/covered_share.h"
#include "core/geo/georeference.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace marsview {
namespace {

Georeference rasterOf(const char* crs, const std::array<double, 6>& terms)
{
    return {12, 10, *GeoTransform::fromTerms(terms), *Crs::fromText(crs)};
}

double shareOf(const Georeference& raster)
{
    const std::array rasters{&raster};
    return coveredShare(rasters);
}

// Half the product of the share of the longitudes and the difference of the sines of the latitudes.
TEST(CoveredShare, IsThatOfTheSphereBetweenMeridiansAndParallels)
{
    const double degree = std::numbers::pi / 180.0;
    for (const double pixel_deg : {0.5, 2.0, 5.0, 9.0}) {
        const Georeference raster =
            rasterOf("IAU_2015:49900", {170.0, pixel_deg, 0.0, 90.0, 0.0, -pixel_deg});
        const double expected =
            12.0 * pixel_deg / 360.0 * (1.0 - std::sin((90.0 - 10.0 * pixel_deg) * degree)) / 2.0;
        EXPECT_NEAR(shareOf(raster), expected, 0.002) << pixel_deg;
    }
    EXPECT_EQ(shareOf(rasterOf("EPSG:4326", {-180.0, 30.0, 0.0, 90.0, 0.0, -18.0})), 1.0);
}

// A square with sides of 1600 km at the pole of a sphere of 3396.19 km: the map's scale grows with
// the distance r from the pole as 1 + (r/2R)².
TEST(CoveredShare, KnowsPolarProjections)
{
    constexpr double kRadius = 3396190.0;
    const Georeference raster =
        rasterOf("IAU_2015:49930", {-800e3, 1600e3 / 12.0, 0.0, 800e3, 0.0, -160e3});
    double expected_m2 = 0.0;
    constexpr int kSteps = 400;
    for (int j = 0; j < kSteps; ++j) {
        for (int i = 0; i < kSteps; ++i) {
            const double x = (2.0 * i + 1.0) / kSteps - 1.0;
            const double y = (2.0 * j + 1.0) / kSteps - 1.0;
            const double r = 800e3 * std::hypot(x, y) / (2.0 * kRadius);
            const double scale = 1.0 + r * r;
            expected_m2 += std::pow(1600e3 / kSteps / scale, 2);
        }
    }
    EXPECT_NEAR(shareOf(raster), expected_m2 / (4.0 * std::numbers::pi * kRadius * kRadius), 0.002);
}

TEST(CoveredShare, CountsPlacesUnderSeveralRastersOnce)
{
    const Georeference west = rasterOf("EPSG:4326", {-90.0, 5.0, 0.0, 40.0, 0.0, -5.0});
    const Georeference east = rasterOf("EPSG:4326", {-60.0, 5.0, 0.0, 40.0, 0.0, -5.0});
    const Georeference both(18, 10, *GeoTransform::fromTerms({-90.0, 5.0, 0.0, 40.0, 0.0, -5.0}),
                            *Crs::fromText("EPSG:4326"));
    const std::array rasters{&west, &east};
    EXPECT_EQ(coveredShare(rasters), shareOf(both));
    EXPECT_EQ(coveredShare({}), 0.0);
}

} // namespace
} // namespace marsview
