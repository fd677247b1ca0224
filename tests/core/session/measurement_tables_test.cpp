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

// On the Earth latitudes are planetographic, and vertices planetocentric: tan(planetocentric) =
// (b/a)² tan(planetographic).
TEST(MeasurementTables, PointsHaveTheirPositionsAndElevationsInFull)
{
    NamedMeasurement named = withValues("IAU_2015:49902", Profile{});
    named.measurement.vertices = {
        GeographicPoint{.longitude = Angle::degrees(226.5), .latitude = Angle::degrees(18.25)},
        GeographicPoint{.longitude = Angle::degrees(18.25), .latitude = Angle::degrees(-0.125)}};
    EXPECT_EQ(pointsText(named), "226.5 18.25 nan; 18.25 -0.125 nan") << "elevations are unknown";
    named.measurement.result = std::make_shared<const MeasurementResult>(
        MeasurementResult{.map = {},
                          .values = MeasuredValues(Profile{}),
                          .elevations_m = {0.1, std::numeric_limits<double>::quiet_NaN()}});
    EXPECT_EQ(pointsText(named), "226.5 18.25 0.1; 18.25 -0.125 nan");
    NamedMeasurement on_earth = withValues("EPSG:4326", Profile{});
    const double b_over_a = 6356752.314245 / 6378137.0;
    const double degree = std::numbers::pi / 180.0;
    const double centric_deg = std::atan(b_over_a * b_over_a * std::tan(40.0 * degree)) / degree;
    EXPECT_NEAR(tablePosition(on_earth, MeasuredVertex(GeographicPoint{
                                            .longitude = Angle::degrees(7.0),
                                            .latitude = Angle::degrees(centric_deg)}))
                    .y,
                40.0, 1e-9);
    on_earth.measurement.vertices = {MapPoint{1.5, -2.0}};
    EXPECT_EQ(pointsText(on_earth), "1.5 -2 nan");
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
