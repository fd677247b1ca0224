#include "core/measure/crater.h"
#include "core/measure/measured_digits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string>

namespace marsview {
namespace {

std::string written(double value, double uncertainty, int unit_power = 0)
{
    const WrittenNumber number = writtenNumber(value, lastPlace(value, uncertainty), unit_power);
    return fmt::format("{:.{}f}", number.value, number.decimals);
}

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

} // namespace

TEST(MeasuredDigits, ANumberEndsWhereTheTwoDigitsOfItsUncertaintyDo)
{
    EXPECT_EQ(written(21345.67, 12.0), "21346");
    EXPECT_EQ(written(21345.67, 12.0, 3), "21.346");
    EXPECT_EQ(written(21345.67, 463.0, 3), "21.35");
    EXPECT_EQ(written(21345.67, 463.0), "21350");
    EXPECT_EQ(written(21345.67, 1.2), "21345.7");
    EXPECT_EQ(written(-21345.67, 12.0), "-21346");
    EXPECT_EQ(written(0.056321, 0.0012), "0.0563");
    EXPECT_EQ(written(0.0, 12.0), "0");
    EXPECT_EQ(written(0.0, 0.12), "0.00");
}

TEST(MeasuredDigits, TwoToSixDigitsRemain)
{
    EXPECT_EQ(written(3.21, 463.0), "3.2") << "smaller than the uncertainty";
    EXPECT_EQ(written(1203456.78, 1.0, 3), "1203.46");
    EXPECT_EQ(written(1203456.78, 0.001), "1203460");
    // Unknown: four.
    EXPECT_EQ(written(412.3456, 0.0), "412.3");
    EXPECT_EQ(written(1203456.78, kUnknown, 3), "1203");
    EXPECT_EQ(written(0.0, 0.0), "0");
}

TEST(MeasuredDigits, PowersOfTenBelongToTheirOwnPlace)
{
    EXPECT_EQ(lastPlace(1e6, 1000.0), 2);
    EXPECT_EQ(lastPlace(1e6, 999.0), 1);
    EXPECT_EQ(lastPlace(1e6, 0.1 * 10000.0), 2);
    EXPECT_EQ(lastPlace(5.0, 0.1), -2);
    EXPECT_EQ(written(999.96, 1.0), "1000.0");
}

// A map of 463 m a sample with whole meters, as MOLA's.
TEST(MeasuredDigits, FollowTheSamplesOfAMap)
{
    const MeasuredDigits mola({.ground_m = 463.0, .height_m = 1.0});
    EXPECT_EQ(mola.length(21345.67), 1);
    EXPECT_EQ(mola.elevation(21171.3), -1);
    EXPECT_EQ(mola.elevation(0.0), -1);
    // 10 km by 10 km: 40 km of border known to 463 m are 18.5 km².
    EXPECT_EQ(mola.area(1e8, 4e4), 6);
    EXPECT_EQ(mola.volume(1.234e10, 1e8), 7) << "10^8 m² known to 1 m";
    EXPECT_EQ(mola.diameter(21345.67, 0.0), 1) << "three points: the samples' distance";
    EXPECT_EQ(mola.diameter(21345.67, 120.0), 1);
    EXPECT_EQ(mola.diameter(21345.67, 1e-6), 0) << "points on a circle by chance";
    EXPECT_EQ(mola.direction(21345.67), -1) << "1.2°";
    EXPECT_EQ(mola.direction(1000.0), 0) << "25°";
    EXPECT_EQ(mola.direction(1e6), -2) << "at most two decimals";
    EXPECT_EQ(anglePlace(2.3), -1);
    EXPECT_EQ(anglePlace(12.0), 0);
    EXPECT_EQ(anglePlace(0.004), -2);
    EXPECT_EQ(anglePlace(180.0), 0);
    EXPECT_EQ(anglePlace(kUnknown), kSlopePlace);
}

// 2026-11: "807.6 m" for a crater of 400 km on samples 14.8 km apart.
TEST(MeasuredDigits, DepthsOfCratersFollowTheSamplesInTheirWalls)
{
    const auto crater = [](double depth_m, double diameter_m, double rms_m = 0.0) {
        Crater made;
        made.diameter_m = diameter_m;
        made.rms_m = rms_m;
        made.depth_m = depth_m;
        made.points = 8;
        return made;
    };
    const MeasuredDigits coarse({.ground_m = 14818.0, .height_m = 1.0});
    EXPECT_EQ(coarse.depth(crater(807.6, 400e3)), 0) << "61 m";
    EXPECT_EQ(coarse.depth(crater(807.6, 60e3)), 1) << "400 m";
    EXPECT_EQ(coarse.depth(crater(-807.6, 60e3)), 1) << "a hill";
    EXPECT_EQ(coarse.depth(crater(12.3, 20e3)), 0) << "two digits remain";
    EXPECT_EQ(coarse.depthToDiameter(crater(807.6, 400e3)), -4) << "0.0020";
    EXPECT_EQ(coarse.depthToDiameter(crater(2400.0, 60e3)), -3) << "0.040";
    const MeasuredDigits mola({.ground_m = 463.0, .height_m = 1.0});
    EXPECT_EQ(mola.depth(crater(1200.0, 21345.67)), 0) << "53 m";
    EXPECT_EQ(mola.depth(crater(1200.0, 21345.67, 2000.0)), 1) << "226 m: not a circle";
    EXPECT_EQ(mola.depthToDiameter(crater(1200.0, 21345.67)), -3);
    const MeasuredDigits stereo({.ground_m = 1.0, .height_m = 0.1});
    EXPECT_EQ(stereo.depth(crater(20.0, 100.0)), -2) << "0.5 m";
    EXPECT_EQ(MeasuredDigits({}).depth(crater(1200.0, 20e3)), 0) << "unknown: four digits";
}

TEST(MeasuredDigits, ElevationsAreKnownToTheStepOfSamplesOrAShareOfTheirDistance)
{
    const auto height_m = [](SampleType type, double gain, double pixel_m) {
        RasterInfo info;
        info.type = type;
        info.scale = gain;
        const auto transform = GeoTransform::fromTerms({0.0, pixel_m, 0.0, 0.0, 0.0, -pixel_m});
        return resolutionOf(Georeference(10, 10, *transform, std::nullopt), info, 1234.5).height_m;
    };
    EXPECT_EQ(height_m(SampleType::Int16, 1.0, 463.0), 1.0);
    EXPECT_EQ(height_m(SampleType::Int16, 0.5, 463.0), 1.0);
    EXPECT_EQ(height_m(SampleType::Int16, 2.0, 463.0), 2.0);
    EXPECT_EQ(height_m(SampleType::Float32, 1.0, 463.0), 1.0);
    EXPECT_NEAR(height_m(SampleType::Float32, 1.0, 1.0), 0.1, 1e-12);
}

} // namespace marsview
