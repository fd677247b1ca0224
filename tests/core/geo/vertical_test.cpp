#include "core/geo/vertical.h"

#include <gtest/gtest.h>

#include <string>

namespace marsview {
namespace {

TEST(VerticalUnit, UnderstandsSpellingsOfRasterFiles)
{
    const struct {
        const char* text;
        const char* name;
        double meters;
    } table[] = {
        {"m", "m", 1.0},
        {"metre", "m", 1.0},
        {"METER", "m", 1.0},
        {"Meters", "m", 1.0},
        {"metres", "m", 1.0},
        {"ft", "ft", 0.3048},
        {"Feet", "ft", 0.3048},
        {"foot", "ft", 0.3048},
        {"US survey foot", "US survey ft", 1200.0 / 3937.0},
        {"ftUS", "US survey ft", 1200.0 / 3937.0},
        {"us-ft", "US survey ft", 1200.0 / 3937.0},
        {"Foot_US", "US survey ft", 1200.0 / 3937.0},
        {"km", "km", 1000.0},
        {"Kilometers", "km", 1000.0},
        {"cm", "cm", 0.01},
        {"dm", "dm", 0.1},
        {"yard", "yd", 0.9144},
        {"fathom", "fathom", 1.8288},
        {"1000*METER", "km", 1000.0},
        {"1000 * METERS", "km", 1000.0},
        {"0.1 m", "dm", 0.1},
        {"1E-2*METER", "cm", 0.01},
        {"0.5*METER", "0.5 m", 0.5},
        {"10 ft", "10 ft", 3.048},
    };
    for (const auto& row : table) {
        const auto unit = verticalUnitFrom(row.text);
        ASSERT_TRUE(unit) << row.text;
        EXPECT_EQ(unit->name, row.name) << row.text;
        EXPECT_EQ(unit->meters, row.meters) << row.text;
    }
}

TEST(VerticalUnit, ReadsBackItsOwnNames)
{
    for (const char* text : {"m", "ft", "ftUS", "km", "cm", "dm", "yd", "fathom", "0.5*m"}) {
        const auto unit = verticalUnitFrom(text);
        ASSERT_TRUE(unit) << text;
        EXPECT_EQ(verticalUnitFrom(unit->name), unit) << text;
    }
}

TEST(VerticalUnit, IsEmptyForTextThatIsNotALength)
{
    for (const char* text :
         {"", " ", "degree", "K", "dBZ", "unknown", "m/s", "mm", "mile", "1", "0*METER", "-1*METER",
          "nan*m", "10**3 m", "1/1000 m", "m^2", "m*10"}) {
        EXPECT_FALSE(verticalUnitFrom(text)) << text;
    }
}

TEST(VerticalUnit, ASurveyFootIsTwoPartsInAMillionLongerThanAFoot)
{
    const double ratio = verticalUnitFrom("ftUS")->meters / verticalUnitFrom("ft")->meters;
    EXPECT_NEAR(ratio, 1.0 + 2e-6, 1e-9);
}

} // namespace
} // namespace marsview
