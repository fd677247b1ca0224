#include "core/geo/coordinate_entry.h"
#include "core/geo/coordinate_format.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace marsview {
namespace {

constexpr auto kDecimal = AngleNotation::DecimalDegrees;
constexpr auto kDms = AngleNotation::DegreesMinutesSeconds;

std::string latitude(double degrees, AngleNotation notation, int digits)
{
    return angleText(latitudeParts(Angle::degrees(degrees), notation, digits));
}

std::string longitude(double degrees, LongitudeNotation range, AngleNotation notation, int digits)
{
    return angleText(longitudeParts(Angle::degrees(degrees), range, notation, digits));
}

std::string span(double west, double east, LongitudeNotation range)
{
    const auto [low, high] =
        longitudeSpanParts(Angle::degrees(west), Angle::degrees(east), range, kDecimal, 0);
    return angleText(low) + " – " + angleText(high);
}

// The size of the last printed digit, in degrees.
long double unitOf(AngleNotation notation, int digits)
{
    if (notation == kDecimal) {
        return std::pow(10.0L, -digits);
    }
    return digits == -2 ? 1.0L : digits == -1 ? 1.0L / 60.0L : std::pow(10.0L, -digits) / 3600.0L;
}

TEST(AngleText, WritesDegreesAndDegreesMinutesSeconds)
{
    EXPECT_EQ(latitude(18.65, kDecimal, 2), "18.65° N");
    EXPECT_EQ(latitude(-18.65, kDecimal, 2), "18.65° S");
    EXPECT_EQ(latitude(18.65, kDms, 0), "18° 39′ 00″ N");
    EXPECT_EQ(latitude(18.66, kDms, 1), "18° 39′ 36.0″ N");
    EXPECT_EQ(latitude(18.66, kDms, -1), "18° 40′ N");
    EXPECT_EQ(latitude(18.66, kDms, -2), "19° N");
    EXPECT_EQ(latitude(7.0 + 5.0 / 60.0 + 3.25 / 3600.0, kDms, 2), "7° 05′ 03.25″ N");
}

TEST(AngleText, CarriesIntoTheNextMinuteAndDegree)
{
    EXPECT_EQ(latitude(18.0 + 39.0 / 60.0 + 59.9999 / 3600.0, kDms, 1), "18° 40′ 00.0″ N");
    EXPECT_EQ(latitude(18.0 + 59.0 / 60.0 + 59.9999 / 3600.0, kDms, 0), "19° 00′ 00″ N");
    EXPECT_EQ(latitude(18.999999, kDecimal, 3), "19.000° N");
    EXPECT_EQ(latitude(89.9999999, kDms, 2), "90° 00′ 00.00″ N");
}

TEST(AngleText, WritesNoNegativeZeroAndNoLatitudeBeyondAPole)
{
    EXPECT_EQ(latitude(-0.0001, kDecimal, 2), "0.00° N");
    EXPECT_EQ(latitude(-0.00001, kDms, 0), "0° 00′ 00″ N");
    EXPECT_EQ(latitude(90.0 + 1e-12, kDecimal, 2), "90.00° N");
    EXPECT_EQ(latitude(-90.1, kDms, 0), "90° 00′ 00″ S");
}

TEST(AngleText, WritesLongitudesInEachRange)
{
    using L = LongitudeNotation;
    struct LongitudeCase {
        double east;
        const char* east_360;
        const char* east_west;
        const char* west_360;
    };
    for (const LongitudeCase& c : std::array{
             LongitudeCase{226.2, "226.20° E", "133.80° W", "133.80° W"},
             LongitudeCase{-133.8, "226.20° E", "133.80° W", "133.80° W"},
             LongitudeCase{10.0, "10.00° E", "10.00° E", "350.00° W"},
             LongitudeCase{0.0, "0.00° E", "0.00° E", "0.00° W"},
             LongitudeCase{-0.001, "0.00° E", "0.00° E", "0.00° W"},
             LongitudeCase{359.999, "0.00° E", "0.00° E", "0.00° W"},
             LongitudeCase{360.0, "0.00° E", "0.00° E", "0.00° W"},
             LongitudeCase{180.0, "180.00° E", "180.00° E", "180.00° W"},
             LongitudeCase{-180.0, "180.00° E", "180.00° E", "180.00° W"},
             LongitudeCase{-179.999, "180.00° E", "180.00° E", "180.00° W"},
             LongitudeCase{-179.99, "180.01° E", "179.99° W", "179.99° W"},
             LongitudeCase{730.5, "10.50° E", "10.50° E", "349.50° W"},
         }) {
        EXPECT_EQ(longitude(c.east, L::East360, kDecimal, 2), c.east_360) << c.east;
        EXPECT_EQ(longitude(c.east, L::EastWest180, kDecimal, 2), c.east_west) << c.east;
        EXPECT_EQ(longitude(c.east, L::West360, kDecimal, 2), c.west_360) << c.east;
    }
}

TEST(LongitudeSpan, EndsAtTheEndOfTheRange)
{
    using L = LongitudeNotation;
    EXPECT_EQ(span(-180.0, 180.0, L::EastWest180), "180° W – 180° E");
    EXPECT_EQ(span(0.0, 360.0, L::EastWest180), "0° E – 360° E");
    EXPECT_EQ(span(-0.04, 359.96, L::EastWest180), "0° E – 360° E");
    EXPECT_EQ(span(30.0, 390.0, L::EastWest180), "180° W – 180° E");
    EXPECT_EQ(span(-180.0, 180.0, L::East360), "0° E – 360° E");
    EXPECT_EQ(span(0.0, 360.0, L::West360), "360° W – 0° W");
    EXPECT_EQ(span(-72.0, -71.0, L::EastWest180), "72° W – 71° W");
    EXPECT_EQ(span(-72.0, -71.0, L::East360), "288° E – 289° E");
    EXPECT_EQ(span(-72.0, -71.0, L::West360), "72° W – 71° W");
    EXPECT_EQ(span(350.0, 360.0, L::East360), "350° E – 360° E");
    EXPECT_EQ(span(0.0, 10.0, L::West360), "360° W – 350° W");
    EXPECT_EQ(span(170.0, 180.0, L::EastWest180), "170° E – 180° E");
    EXPECT_EQ(span(180.0, 190.0, L::EastWest180), "180° W – 170° W");
    EXPECT_EQ(span(350.0, 370.0, L::East360), "350° E – 10° E");
}

TEST(AngleText, ReadsBackWithinHalfItsLastDigit)
{
    test::Random random;
    for (int i = 0; i < 10000; ++i) {
        const bool is_dms = random.chance(0.5);
        const AngleNotation notation = is_dms ? kDms : kDecimal;
        const int digits =
            is_dms ? static_cast<int>(random.below(8)) - 2 : static_cast<int>(random.below(9));
        const auto range = static_cast<LongitudeNotation>(random.below(3));
        // Every tenth position lies at a seam or within one digit of it.
        const bool is_seam = random.chance(0.1);
        const long double unit = unitOf(notation, digits);
        const auto near = [&](double place) {
            return place + random.uniform(-1.0, 1.0) * static_cast<double>(unit);
        };
        const double lat =
            is_seam
                ? std::clamp(near(90.0 * (static_cast<double>(random.below(3)) - 1.0)), -90.0, 90.0)
                : random.uniform(-90.0, 90.0);
        const double lon = is_seam ? near(180.0 * (static_cast<double>(random.below(5)) - 2.0))
                                   : random.uniform(-360.0, 360.0);
        const AngleParts north = latitudeParts(Angle::degrees(lat), notation, digits);
        const AngleParts east = longitudeParts(Angle::degrees(lon), range, notation, digits);
        for (const AngleParts& parts : {north, east}) {
            EXPECT_GE(parts.minutes, 0);
            EXPECT_LT(parts.minutes, 60);
            EXPECT_GE(parts.seconds, 0.0);
            EXPECT_LT(parts.seconds, 60.0);
        }
        const std::string text = angleText(north) + ", " + angleText(east);
        EXPECT_EQ(text.find("60′"), std::string::npos) << text;
        switch (range) {
        case LongitudeNotation::East360:
            EXPECT_EQ(east.direction, 'E') << text;
            EXPECT_LT(east.degrees, 360.0) << text;
            break;
        case LongitudeNotation::West360:
            EXPECT_EQ(east.direction, 'W') << text;
            EXPECT_LT(east.degrees, 360.0) << text;
            break;
        case LongitudeNotation::EastWest180:
            EXPECT_LE(east.degrees, 180.0) << text;
            break;
        }
        const auto place = placeFrom(text);
        ASSERT_TRUE(place) << text << ": " << place.error().message;
        const auto half = static_cast<double>(unit * 0.5L) + 1e-11;
        EXPECT_NEAR(place->latitude.degrees(), lat, half) << text;
        EXPECT_NEAR(std::remainder(place->longitude.degrees() - lon, 360.0), 0.0, half) << text;
    }
}

TEST(DigitsFor, ReturnsTheFewestThatResolveTheStep)
{
    const auto decimal = [](double step) { return digitsFor(kDecimal, Angle::degrees(step)); };
    EXPECT_EQ(decimal(1.0), 0);
    EXPECT_EQ(decimal(0.1), 1);
    EXPECT_EQ(decimal(0.025), 2);
    EXPECT_EQ(decimal(1e-12), 8);
    EXPECT_EQ(decimal(0.0), 8);
    const auto dms = [](double step) { return digitsFor(kDms, Angle::degrees(step)); };
    EXPECT_EQ(dms(1.0), -2);
    EXPECT_EQ(dms(0.025), -1);
    EXPECT_EQ(dms(1.0 / 3600.0), 0);
    EXPECT_EQ(dms(0.01 / 3600.0), 2);
    EXPECT_EQ(dms(0.0), 5);
}

TEST(CoordinateFormat, KeepsTheKindOfLatitudePerBody)
{
    CoordinateFormat format;
    const Body* mars = bodyNamed("Mars");
    const Body* earth = bodyNamed("Earth");
    EXPECT_EQ(format.latitudesOn(mars), LatitudeKind::Planetocentric);
    EXPECT_EQ(format.latitudesOn(earth), LatitudeKind::Planetographic);
    EXPECT_EQ(format.latitudesOn(nullptr), LatitudeKind::Planetocentric);
    format.setLatitudesOn(mars, LatitudeKind::Planetographic);
    EXPECT_EQ(format.latitudesOn(mars), LatitudeKind::Planetographic);
    EXPECT_EQ(format.latitudesOn(bodyNamed("Moon")), LatitudeKind::Planetocentric);
    format.setLatitudesOn(mars, LatitudeKind::Planetocentric);
    EXPECT_EQ(format.latitudesOn(earth), LatitudeKind::Planetographic);
    EXPECT_EQ(format, CoordinateFormat{}); // a body's usual choice is not stored
}

TEST(CoordinateFormat, WritesLongitudesAsUsualOnTheBodyUnlessChosen)
{
    CoordinateFormat format;
    EXPECT_EQ(format.longitudesOn(bodyNamed("Mars")), LongitudeNotation::East360);
    EXPECT_EQ(format.longitudesOn(bodyNamed("Moon")), LongitudeNotation::EastWest180);
    EXPECT_EQ(format.longitudesOn(bodyNamed("Earth")), LongitudeNotation::EastWest180);
    format.longitudes = LongitudeNotation::West360;
    EXPECT_EQ(format.longitudesOn(bodyNamed("Mars")), LongitudeNotation::West360);
}

} // namespace
} // namespace marsview
