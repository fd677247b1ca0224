#include "core/formats/pds3_placement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace marsview {
namespace {

using nlohmann::json;

constexpr double kPixel_m = 14818.0;

json label(double north_deg, double west_deg)
{
    return {{"IMAGE_MAP_PROJECTION",
             {{"MAXIMUM_LATITUDE", {{"value", north_deg}, {"unit", "DEGREE"}}},
              {"WESTERNMOST_LONGITUDE", west_deg}}}};
}

Crs simpleCylindrical()
{
    return *Crs::fromText("+proj=eqc +lon_0=180 +R=3396000 +no_defs");
}

// The outer corner of the first pixel is `columns` and `rows` pixels away from the map's corner.
GeoTransform offBy(double columns, double rows)
{
    return *GeoTransform::fromTerms(
        {(columns - 720.0) * kPixel_m, kPixel_m, 0.0, (360.0 - rows) * kPixel_m, 0.0, -kPixel_m});
}

TEST(Pds3Placement, KeepsAGridThatMatchesItsLabel)
{
    EXPECT_TRUE(pds3PlacementShift(label(90.0, 0.0), offBy(0, 0), simpleCylindrical()).isNone());
    EXPECT_TRUE(pds3PlacementShift(label(90.0, 360.0), offBy(0, 0), simpleCylindrical()).isNone());
}

TEST(Pds3Placement, ShiftsAGridThatIsOffByOnePixel)
{
    for (const int columns : {-1, 0, 1}) {
        for (const int rows : {-1, 0, 1}) {
            for (const double west : {0.0, 360.0, -360.0}) {
                const PixelShift shift = pds3PlacementShift(label(90.0, west), offBy(columns, rows),
                                                            simpleCylindrical());
                EXPECT_EQ(shift.columns, -columns) << rows << " " << west;
                EXPECT_EQ(shift.rows, -rows) << columns << " " << west;
            }
        }
    }
}

TEST(Pds3Placement, IgnoresAnyOtherDisagreement)
{
    for (const double off : {0.3, 0.5, 0.7, 1.5, 2.0, 3.0, 100.0}) {
        EXPECT_TRUE(
            pds3PlacementShift(label(90.0, 0.0), offBy(off, off), simpleCylindrical()).isNone())
            << off;
    }
}

TEST(Pds3Placement, IgnoresWestPositiveLabelsAndOtherProjections)
{
    json west = label(90.0, 0.0);
    west["IMAGE_MAP_PROJECTION"]["POSITIVE_LONGITUDE_DIRECTION"] = "WEST";
    EXPECT_TRUE(pds3PlacementShift(west, offBy(1, 1), simpleCylindrical()).isNone());
    const Crs polar = *Crs::fromText("+proj=stere +lat_0=90 +R=3396000 +no_defs");
    EXPECT_TRUE(pds3PlacementShift(label(90.0, 0.0), offBy(1, 1), polar).isNone());
}

TEST(Pds3Placement, IgnoresLabelsWithoutUsableLimits)
{
    const json labels[] = {
        json(),
        json::object(),
        json::array({1, 2}),
        json("text"),
        {{"IMAGE_MAP_PROJECTION", "N/A"}},
        {{"IMAGE_MAP_PROJECTION", json::object()}},
        {{"IMAGE_MAP_PROJECTION", {{"MAXIMUM_LATITUDE", "N/A"}, {"WESTERNMOST_LONGITUDE", 0}}}},
        {{"IMAGE_MAP_PROJECTION",
          {{"MAXIMUM_LATITUDE", {{"value", "N/A"}}}, {"WESTERNMOST_LONGITUDE", 0}}}},
        {{"IMAGE_MAP_PROJECTION",
          {{"MAXIMUM_LATITUDE", 90}, {"WESTERNMOST_LONGITUDE", json::array({0})}}}},
        {{"IMAGE_MAP_PROJECTION",
          {{"MAXIMUM_LATITUDE", 90},
           {"WESTERNMOST_LONGITUDE", 0},
           {"POSITIVE_LONGITUDE_DIRECTION", 1}}}},
    };
    for (const json& l : labels) {
        EXPECT_TRUE(pds3PlacementShift(l, offBy(0, 0), simpleCylindrical()).isNone()) << l.dump();
    }
}

TEST(Pds3Placement, MovingUsesAllSixTerms)
{
    const GeoTransform turned = *GeoTransform::fromTerms({10.0, 3.0, 4.0, 20.0, 4.0, -3.0});
    EXPECT_EQ(shifted(turned, {.columns = 1, .rows = -1}).terms(),
              (GeoTransform::Terms{10.0 + 3.0 - 4.0, 3.0, 4.0, 20.0 + 4.0 + 3.0, 4.0, -3.0}));
}

} // namespace
} // namespace marsview
