#include "haptics/trace/ground_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace marsview {
namespace {

TEST(GroundText, ReadsBackWhatItWritesToTheBit)
{
    constexpr double kThird = 1.0 / 3.0;
    const std::vector<GroundRecord> records{
        GroundPart{.part = ~std::uint64_t{0},
                   .columns = 106694,
                   .rows = 53347,
                   .ellipsoid = {3396190.0, 3376200.0},
                   .frame = {.origin = {kThird, -1e-300},
                             .east_per_column = std::nextafter(200.0, 0.0),
                             .east_per_row = -0.0,
                             .north_per_column = 1e-22,
                             .north_per_row = -kThird}},
        GroundBelow{{.part = 3,
                     .columns = 41,
                     .rows = 33,
                     .ellipsoid = {1737400.0, 1737400.0},
                     .frame = {.origin = {20.0, 16.0},
                               .east_per_column = 1000.0,
                               .east_per_row = 0.0,
                               .north_per_column = 0.0,
                               .north_per_row = -1000.0}}},
        GroundLevel{23, {4'000'000, 17, 8, 8, ~std::uint64_t{0}}},
        GroundLevel{0, {0, 0, 1, 1, 0}},
        GroundTile{{TileKind::Samples, 9, 3, 70'000}, std::nextafter(1.0, 0.0)},
        GroundTile{{TileKind::Samples, 0, 0, 0}, std::numeric_limits<double>::denorm_min()},
        GroundLevel{1, {0, 0, 2, 2, 5}, 0},
        GroundLevel{1, {0, 0, 2, 2, 5}, 31},
        GroundTile{{TileKind::Samples, 2, 1, 0}, 0.25, 2},
        GroundFelt{0},
        GroundFelt{12}};
    std::string cell;
    for (const GroundRecord& record : records) {
        cell += (cell.empty() ? "" : " ") + groundText(record);
    }
    EXPECT_EQ(cell.find(','), std::string::npos) << "it is the cell of a table";
    EXPECT_EQ(parseGround(cell), records) << cell;
    EXPECT_EQ(parseGround(""), std::vector<GroundRecord>{});
}

// Of recordings in which only one of the maps could be in tiles.
TEST(GroundText, ReadsTilesWithoutTheIndexOfTheirMap)
{
    EXPECT_EQ(
        parseGround("level/1/0/0/2/2/5 tile/2/1/0/0.25"),
        (std::vector<GroundRecord>{GroundLevel{1, {0, 0, 2, 2, 5}, std::nullopt},
                                   GroundTile{{TileKind::Samples, 2, 1, 0}, 0.25, std::nullopt}}));
    EXPECT_EQ(groundText(GroundLevel{1, {0, 0, 2, 2, 5}, std::nullopt}), "level/1/0/0/2/2/5");
}

TEST(GroundText, RefusesInvalidText)
{
    for (const char* cell : {"felt",
                             "felt/",
                             "felt/-1",
                             "felt/1/2",
                             "fell/1",
                             "level/0/0/0/1/1",
                             "level/0/0/0/1/1/g",
                             "level/0/0/0/1/1/1ffffffffffffffff",
                             "tile/0/0/0/1",
                             "tile/0/0/0/-0.5",
                             "tile/0/0/0/nan",
                             "tile/0/0/0/0.5/",
                             "tile/0/0/0/0.5/-1",
                             "tile/0/0/0/0.5/1/1",
                             "level/0/0/0/1/1/1/",
                             "level/0/0/0/1/1/1/x",
                             "level/0/0/0/1/1/1/4294967296",
                             "tile/256/0/0/0.5",
                             "part/1/2/3",
                             "below/1/2/3",
                             "part/1/40/30/1.0/1.0/0.0/0.0/0.0/0.0/0.0/-1.0",
                             "part/1/40/30/1.0/1.0/nan/0.0/1.0/0.0/0.0/-1.0",
                             "part/1/40/30/1.0/1.0/0.0/0.0/1e308/0.0/0.0/-1.0",
                             "part/1/40/30/1.0/1.0/0.0/inf/1.0/0.0/0.0/-1.0",
                             "part/1/40/30/1.0/1.0/0.0/0.0/1.0/nan/0.0/-1.0",
                             " felt/1",
                             "felt/1  felt/2",
                             "/",
                             "nan"}) {
        EXPECT_FALSE(parseGround(cell)) << cell;
    }
}

} // namespace
} // namespace marsview
