#include "core/session/measurement_tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace marsview {
namespace {

NamedMeasurement withValues(const char* crs, MeasuredValues values)
{
    NamedMeasurement named;
    named.measurement.name = "Bed “7”, lower";
    named.layer_name = "DEM";
    if (crs != nullptr) {
        named.crs = *Crs::fromText(crs);
    }
    named.measurement.result = std::make_shared<const MeasurementResult>(
        MeasurementResult{.map = {}, .values = std::move(values)});
    return named;
}

// tan(planetocentric) = (b/a)² tan(planetographic)
TEST(MeasurementTables, LatitudesAreThoseOfTheBodysMaps)
{
    const double graphic_deg = 40.0;
    const double b_over_a = 3376200.0 / 3396190.0;
    const double degree = std::numbers::pi / 180.0;
    const double centric_deg =
        std::atan(b_over_a * b_over_a * std::tan(graphic_deg * degree)) / degree;
    const auto latitude = [&](const char* crs) {
        return tablePosition(withValues(crs, Profile{}), {20.0, graphic_deg}).y;
    };
    EXPECT_NEAR(latitude("IAU_2015:49902"), centric_deg, 1e-9);  // Mars, on its ellipsoid
    EXPECT_NEAR(latitude("IAU_2015:49900"), graphic_deg, 1e-12); // on a sphere
    EXPECT_EQ(latitude("EPSG:4326"), graphic_deg);
    EXPECT_EQ(latitude(nullptr), graphic_deg);
}

TEST(MeasurementTables, AProfileKeepsEveryDigitAndItsGaps)
{
    Profile profile;
    profile.points.push_back(
        {.distance_m = 0.1, .position = {226.2, 18.65}, .elevation_m = 1.0 / 3});
    profile.points.push_back({.distance_m = 20.0,
                              .position = {226.3, 18.65},
                              .elevation_m = std::numeric_limits<double>::quiet_NaN()});
    EXPECT_EQ(profileCsv(withValues("IAU_2015:30100", profile)),
              "distance_m,lon,lat,elevation_m\n"
              "0.1,226.2,18.65,0.3333333333333333\n"
              "20,226.3,18.65,nan\n");
}

TEST(MeasurementTables, AnAttitudeIsALineWithQuotesWhereTheyAreNeeded)
{
    Attitude attitude;
    attitude.center = {10.0, 5.0};
    attitude.center_elevation_m = -2500.5;
    attitude.strike_deg = 45.0;
    attitude.dip_deg = 12.5;
    attitude.dip_direction_deg = 135.0;
    attitude.uncertainty.strike_error_deg = 4.0;
    attitude.uncertainty.dip_error_deg = 0.5;
    attitude.rms_m = 0.25;
    attitude.points = 6;
    const std::vector<NamedMeasurement> measurements{withValues("IAU_2015:30100", attitude),
                                                     withValues("IAU_2015:30100", Profile{})};
    EXPECT_EQ(attitudesCsv(measurements),
              "name,lon,lat,elevation_m,strike,dip,dip_direction,strike_error,dip_error,rms_m,"
              "points,layer,note\n"
              "\"Bed “7”, lower\",10,5,-2500.5,45,12.5,135,4,0.5,0.25,6,DEM,\n");
}

TEST(MeasurementTables, FieldsAreQuotedAsRfc4180Says)
{
    EXPECT_EQ(csvField("plain"), "plain");
    EXPECT_EQ(csvField("a \"b\", c"), "\"a \"\"b\"\", c\"");
    EXPECT_EQ(csvField("two\nlines"), "\"two\nlines\"");
}

} // namespace
} // namespace marsview
