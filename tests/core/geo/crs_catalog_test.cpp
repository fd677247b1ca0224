#include "core/geo/crs.h"
#include "core/geo/crs_catalog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace marsview {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> codesFor(const CrsCatalog& catalogue,
                                  std::string_view query,
                                  std::size_t count_max = 5,
                                  const Body* body = nullptr)
{
    std::vector<std::string> codes;
    for (const CrsEntry* entry : catalogue.search(query, count_max, body)) {
        codes.push_back(entry->code);
    }
    return codes;
}

const CrsCatalog& database()
{
    static const CrsCatalog catalogue = CrsCatalog::fromDatabase();
    return catalogue;
}

// The codes are those of the EPSG registry and of the IAU 2015 list.
TEST(CrsCatalog, FindsSystemsByCommonQueries)
{
    ASSERT_GT(database().size(), 5000U);
    EXPECT_EQ(codesFor(database(), "WGS 84").at(0), "EPSG:4326");
    EXPECT_EQ(codesFor(database(), "wgs84").at(0), "EPSG:4326");
    EXPECT_EQ(codesFor(database(), "UTM 10N").at(0), "EPSG:32610");
    EXPECT_EQ(codesFor(database(), "utm zone 33s").at(0), "EPSG:32733");
    EXPECT_EQ(codesFor(database(), "49900").at(0), "IAU_2015:49900");
    EXPECT_EQ(codesFor(database(), "epsg:3413").at(0), "EPSG:3413");
    EXPECT_EQ(codesFor(database(), "Mars equirectangular").at(0), "IAU_2015:49910");
    EXPECT_EQ(codesFor(database(), "Mars simple cylindrical").at(0), "IAU_2015:49910");
    EXPECT_EQ(codesFor(database(), "moon north polar").at(0), "IAU_2015:30130");
    EXPECT_EQ(codesFor(database(), "lunar north polar").at(0), "IAU_2015:30130");
    EXPECT_THAT(codesFor(database(), "california albers", 3), Contains("EPSG:3310"));
    EXPECT_THAT(codesFor(database(), "mars geogr ograph", 20), IsEmpty());
}

TEST(CrsCatalog, StatesTheBodyOfEverySystem)
{
    const auto body_of = [](std::string_view query) {
        const auto hits = database().search(query, 1);
        return hits.empty() || hits[0]->body == nullptr ? std::string_view() : hits[0]->body->name;
    };
    EXPECT_EQ(body_of("IAU_2015:49910"), "Mars");
    EXPECT_EQ(body_of("IAU_2015:30100"), "Moon");
    EXPECT_EQ(body_of("EPSG:32610"), "Earth");
    EXPECT_EQ(body_of("ESRI:104905"), "Mars");
    EXPECT_EQ(body_of("EPSG:7299"), "Earth"); // "… Fulton-Marshall-St. Joseph"
}

TEST(CrsCatalog, RanksSystemsOfTheGivenBodyFirst)
{
    const auto hits = database().search("equirectangular", 2, bodyNamed("Moon"));
    ASSERT_EQ(hits.size(), 2U); // differ only in the near and the far side
    for (const CrsEntry* entry : hits) {
        EXPECT_EQ(entry->body, bodyNamed("Moon")) << entry->code;
    }
}

TEST(CrsCatalog, ListsOnlyUsableSystems)
{
    for (const char* query : {"mars", "moon polar", "utm 10", "lambert france", "ceres", "earth"}) {
        for (const CrsEntry* entry : database().search(query, 8)) {
            const auto crs = Crs::fromText(entry->code);
            EXPECT_TRUE(crs) << entry->code << " (" << entry->name
                             << "): " << (crs ? "" : crs.error().message);
        }
    }
}

TEST(CrsCatalog, MatchesEveryWordOfTheQuery)
{
    const Body* mars = bodyNamed("Mars");
    const CrsCatalog catalogue(
        {{.code = "A:1", .name = "Red Plain", .body = mars, .area = "North of the river"},
         {.code = "A:2", .name = "Red Hill", .body = mars},
         {.code = "A:12", .name = "Plain", .body = nullptr}});
    EXPECT_THAT(codesFor(catalogue, "red"), ElementsAre("A:2", "A:1")); // the shorter name first
    EXPECT_THAT(codesFor(catalogue, "RED pl"), ElementsAre("A:1"));
    EXPECT_THAT(codesFor(catalogue, "plain"), ElementsAre("A:12", "A:1"));
    EXPECT_THAT(codesFor(catalogue, "river"), ElementsAre("A:1"));
    EXPECT_THAT(codesFor(catalogue, "mars"), ElementsAre("A:2", "A:1"));
    EXPECT_THAT(codesFor(catalogue, "1"), ElementsAre("A:1", "A:12"));
    EXPECT_THAT(codesFor(catalogue, "plain", 1), ElementsAre("A:12"));
    EXPECT_THAT(codesFor(catalogue, "  , "), IsEmpty());
    EXPECT_THAT(codesFor(catalogue, "green"), IsEmpty());
}

} // namespace
} // namespace marsview
