#include "core/geo/body_layout.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

namespace marsview {
namespace {

Georeference layoutGeoreference(std::size_t columns,
                                std::size_t rows,
                                const GeoTransform::Terms& terms,
                                const std::string& crs = "IAU_2015:49900")
{
    return {columns, rows, *GeoTransform::fromTerms(terms), *Crs::fromText(crs)};
}

} // namespace

TEST(BodyLayout, StatesWhichSamplesAreUsedAndWhereTheyClose)
{
    struct Known {
        Georeference georeference;
        BodyLayout layout;
    };
    const std::vector<Known> known{
        // Pixels around the body.
        {layoutGeoreference(360, 180, {0, 1, 0, 90, 0, -1}),
         {360, 180, 0, false, true, true, true}},
        // Samples on lines, also at both poles and twice at the seam.
        {layoutGeoreference(361, 181, {-0.5, 1, 0, 90.5, 0, -1}),
         {360, 179, 1, true, true, true, true}},
        // A belt, a northern cap that begins a whole cell away, and one that begins further away.
        {layoutGeoreference(360, 100, {0, 1, 0, 50, 0, -1}),
         {360, 100, 0, false, true, false, false}},
        {layoutGeoreference(360, 10, {0, 1, 0, 89.5, 0, -1}),
         {360, 10, 0, false, true, true, false}},
        {layoutGeoreference(360, 10, {0, 1, 0, 89.4, 0, -1}),
         {360, 10, 0, false, true, false, false}},
        // From south to north, and a part of the turn.
        {layoutGeoreference(360, 10, {0, 1, 0, -90, 0, 1}), {360, 10, 0, false, true, true, false}},
        {layoutGeoreference(300, 180, {0, 1, 0, 90, 0, -1}),
         {300, 180, 0, false, false, false, false}},
    };
    for (const auto& [georeference, expected] : known) {
        ASSERT_TRUE(hasMeridiansAsColumns(georeference));
        const Result<BodyLayout> layout = bodyLayout(georeference);
        ASSERT_TRUE(layout) << layout.error().message;
        EXPECT_EQ(layout->columns, expected.columns);
        EXPECT_EQ(layout->rows, expected.rows);
        EXPECT_EQ(layout->first_row, expected.first_row);
        EXPECT_EQ(layout->has_row_after, expected.has_row_after);
        EXPECT_EQ(layout->wraps, expected.wraps);
        EXPECT_EQ(layout->closes_first, expected.closes_first);
        EXPECT_EQ(layout->closes_last, expected.closes_last);
    }
}

TEST(BodyLayout, RefusesMoreThanATurn)
{
    const Result<BodyLayout> layout =
        bodyLayout(layoutGeoreference(400, 100, {0, 1, 0, 50, 0, -1}));
    ASSERT_FALSE(layout);
    EXPECT_EQ(layout.error().message, "extends over 399° of longitude; a body has 360°");
}

TEST(BodyLayout, NeedsColumnsThatAreMeridians)
{
    EXPECT_FALSE(hasMeridiansAsColumns(layoutGeoreference(360, 180, {0, 1, 0.1, 90, 0, -1})));
    EXPECT_FALSE(hasMeridiansAsColumns(layoutGeoreference(
        100, 100, {-5e4, 1e3, 0, 5e4, 0, -1e3}, "+proj=stere +lat_0=90 +R=1737400 +units=m")));
    EXPECT_FALSE(hasMeridiansAsColumns(layoutGeoreference(100, 100, {-5e4, 1e3, 0, 5e4, 0, -1e3},
                                                          "+proj=sinu +R=1737400 +units=m")));
    EXPECT_TRUE(hasMeridiansAsColumns(layoutGeoreference(100, 100, {-5e4, 1e3, 0, 5e4, 0, -1e3},
                                                         "+proj=eqc +R=1737400 +units=m")));
}

} // namespace marsview
