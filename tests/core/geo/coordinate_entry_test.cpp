#include "core/geo/coordinate_entry.h"
#include "tests/support/random.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace marsview {
namespace {

using testing::HasSubstr;

constexpr double kSecond = 1.0 / 3600.0;

struct Case {
    const char* text;
    double latitude_deg;
    double longitude_deg;
};

TEST(PlaceFrom, UnderstandsCommonNotations)
{
    for (const Case& c : std::vector<Case>{
             {"18.65 N 226.2 E", 18.65, 226.2},
             {"18.65N226.2E", 18.65, 226.2},
             {"18.65° N 226.20° E", 18.65, 226.2}, // as the status bar prints it
             {"N 18.65 E 226.2", 18.65, 226.2},
             {"n18.65, e226.2", 18.65, 226.2},
             {"226.2°E, 18.65°N", 18.65, 226.2},
             {"18.65 S 133.8 W", -18.65, -133.8},
             {"18,65 N 226,2 E", 18.65, 226.2},
             {"18,65N, 226,2E", 18.65, 226.2},
             {"18,65; 226,2", 18.65, 226.2},
             {"18,65 226,2", 18.65, 226.2},
             {"18,65, 226,2", 18.65, 226.2},
             {"-18,65 -133,8", -18.65, -133.8},
             {"18°39′36,5″ 226°12′0,5″", 18.66 + 0.5 * kSecond, 226.2 + 0.5 * kSecond},
             {"18,226", 18.0, 226.0},                           // one comma as the separator
             {"\u206618.65° N, 226.20° E\u2069", 18.65, 226.2}, // in right-to-left isolates
             {"\u0661\u0668\u066B\u0666\u0665 N \u0662\u0662\u0666\u066B\u0662 E", 18.65,
              226.2}, // Arabic digits
             {"18.65, 226.2", 18.65, 226.2},
             {"18.65 226.2", 18.65, 226.2},
             {"-18.65 -133.8", -18.65, -133.8},
             {"\u221218.65, \u2212133.8", -18.65, -133.8},
             {"18°39′00″N 133°48′W", 18.65, -133.8},
             {"18°39'36\"S 226°12'E", -(18 + 39.0 / 60 + 36 * kSecond), 226.2},
             {"18°39'36''S 226°12'E", -(18 + 39.0 / 60 + 36 * kSecond), 226.2},
             {"18 39 36 N 133 48 00 W", 18 + 39.0 / 60 + 36 * kSecond, -133.8},
             {"18 39 36 226 12 0", 18 + 39.0 / 60 + 36 * kSecond, 226.2},
             {"18 39.6 226 12", 18.66, 226.2},
             {"18:39, 226:12", 18.65, 226.2},
             {"18:39:36 226:12:00", 18.66, 226.2},
             {"18°39' 226°", 18.65, 226.0},
             {"-0 30, 0", -0.5, 0.0},
             {"-0°30', 0°", -0.5, 0.0},
             {"90 N 360 E", 90.0, 360.0},
         }) {
        const auto place = placeFrom(c.text);
        ASSERT_TRUE(place) << c.text << ": " << place.error().message;
        EXPECT_NEAR(place->latitude.degrees(), c.latitude_deg, 1e-12) << c.text;
        EXPECT_NEAR(place->longitude.degrees(), c.longitude_deg, 1e-12) << c.text;
    }
}

TEST(PlaceFrom, ReadsBareLongitudesInTheDirectionOfTheFormat)
{
    const auto longitude = [](const char* text) {
        return placeFrom(text, BareLongitude::West)->longitude.degrees();
    };
    EXPECT_NEAR(longitude("18.65, 133.8"), -133.8, 1e-12);
    EXPECT_NEAR(longitude("18.65, -133.8"), 133.8, 1e-12);
    EXPECT_NEAR(longitude("18.65 N 133.8 E"), 133.8, 1e-12); // letters take precedence
    EXPECT_NEAR(longitude("18.65 N 133.8 W"), -133.8, 1e-12);
}

TEST(PlaceFrom, ErrorsNameTheProblem)
{
    const auto message = [](const char* text) {
        const auto place = placeFrom(text);
        return place ? "understood as a place" : place.error().message;
    };
    EXPECT_THAT(message(""), HasSubstr("latitude and a longitude are needed"));
    EXPECT_THAT(message("18.65"), HasSubstr("latitude and a longitude are needed"));
    EXPECT_THAT(message("18.65 N"), HasSubstr("latitude and a longitude are needed"));
    EXPECT_THAT(message("1 2 3"), HasSubstr("latitude and a longitude are needed"));
    EXPECT_THAT(message("Olympus"), HasSubstr("\"Olympus\" is not understood"));
    EXPECT_THAT(message("18.65 N 226.2 N"), HasSubstr("N and N are the same direction"));
    EXPECT_THAT(message("91, 0"), HasSubstr("latitude 91 is beyond 90"));
    EXPECT_THAT(message("0, 361"), HasSubstr("longitude 361 is beyond 360"));
    EXPECT_THAT(message("18 61 N 5 E"), HasSubstr("61 is too large; minutes"));
    EXPECT_THAT(message("18.5 30 N 5 E"), HasSubstr("only the last part"));
    EXPECT_THAT(message("-18 N 5 E"), HasSubstr("contradict"));
    EXPECT_THAT(message("18'39° N 5 E"), HasSubstr("out of order"));
    EXPECT_THAT(message("1,2,3"), HasSubstr("more than one comma"));
    EXPECT_THAT(message("N E"), HasSubstr("a number is missing"));
    EXPECT_THAT(message("1 2 3 4 N 5 E"), HasSubstr("at most degrees, minutes and seconds"));
    EXPECT_THAT(message("1e4, 2"), HasSubstr("are needed"));
}

TEST(PlaceFrom, ReadsBackDegreesMinutesAndSeconds)
{
    test::Random random;
    for (int i = 0; i < 2000; ++i) {
        const double lat = random.uniform(0.0, 90.0);
        const double lon = random.uniform(0.0, 360.0);
        const auto dms = [](double degrees) {
            const double minutes = (degrees - std::floor(degrees)) * 60.0;
            const double seconds = (minutes - std::floor(minutes)) * 60.0;
            return fmt::format("{}°{}′{:.9f}″", std::floor(degrees), std::floor(minutes),
                               std::min(seconds, 59.999999999));
        };
        const bool is_south = random.chance(0.5);
        const bool is_west = random.chance(0.5);
        const std::string north = dms(lat) + (is_south ? "S" : "N");
        const std::string east = dms(lon) + (is_west ? "W" : "E");
        const std::string text = random.chance(0.5) ? north + " " + east : east + ", " + north;
        const auto place = placeFrom(text);
        ASSERT_TRUE(place) << text << ": " << place.error().message;
        EXPECT_NEAR(place->latitude.degrees(), is_south ? -lat : lat, 1e-12) << text;
        EXPECT_NEAR(place->longitude.degrees(), is_west ? -lon : lon, 1e-12) << text;
    }
}

TEST(PlaceFrom, SurvivesAnyText)
{
    test::Random random;
    const std::string alphabet = "0123456789.,;:'\"-+ NSEWnsewx°′″−\u202F";
    for (int i = 0; i < 20000; ++i) {
        std::string text;
        const std::size_t length = random.below(16);
        for (std::size_t k = 0; k < length; ++k) {
            text += alphabet[random.below(alphabet.size())];
        }
        const auto place = placeFrom(text);
        if (place) {
            EXPECT_LE(std::abs(place->latitude.degrees()), 90.0 + 1e-9) << text;
            EXPECT_LE(std::abs(place->longitude.degrees()), 360.0 + 1e-9) << text;
        }
        (void)mapPointFrom(text);
    }
}

TEST(MapPointFrom, ReadsTwoPlainNumbers)
{
    for (const char* text :
         {"562345.5 -5117890", "562345.5, -5117890", "562345.5; -5117890",
          "562345,5; \u22125117890", "562345,5 -5117890,0", " 562345.5\t-5117890 "}) {
        const auto point = mapPointFrom(text);
        ASSERT_TRUE(point) << text << ": " << point.error().message;
        EXPECT_EQ(*point, (MapPoint{562345.5, -5117890.0})) << text;
    }
    for (const char* text : {"", "1", "1 2 3", "1,2,3", "1 N 2 E", "x y", ", 1 2"}) {
        EXPECT_FALSE(mapPointFrom(text)) << text;
    }
}

} // namespace
} // namespace marsview
