#include "core/tiles/tile_checksums.h"
#include "tests/support/make_terrain.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <zlib.h>

namespace marsview {
namespace {

TEST(TileChecksums, ExistForEveryStoredTile)
{
    const TileLayout layout{.columns = 1100, .rows = 700, .mean_levels = 3};
    TileChecksums checksums(layout);
    std::uint32_t next = 0;
    std::vector<TileId> ids;
    for (std::uint8_t level = 0; level <= 3; ++level) {
        const TileKind kind = level == 0 ? TileKind::Samples : TileKind::Means;
        for (std::uint32_t row = 0; row < layout.tileRows(kind, level); ++row) {
            for (std::uint32_t column = 0; column < layout.tileColumns(kind, level); ++column) {
                ids.push_back({kind, level, column, row});
                checksums.set(ids.back(), ++next);
            }
        }
    }
    EXPECT_EQ(TileChecksums::countFor(layout), ids.size());
    EXPECT_EQ(checksums.values().size(), ids.size());
    next = 0;
    for (const TileId& id : ids) {
        EXPECT_TRUE(TileChecksums::covers(id));
        EXPECT_EQ(checksums.of(id), ++next);
    }
    EXPECT_FALSE(TileChecksums::covers({TileKind::Samples, 1, 0, 0}));
}

TEST(TileChecksums, MatchZlibForWholeTilesAndParts)
{
    test::Random random;
    for (const SampleType type : {SampleType::UInt8, SampleType::Int16, SampleType::Float64}) {
        SampleGrid grid = SampleGrid::create(type, 300, 200).value();
        const std::size_t bytes = sampleBytes(type);
        for (std::size_t i = 0; i < 300 * 200 * bytes; ++i) {
            grid.rowData(0)[i] = static_cast<std::byte>(random.bits());
        }
        EXPECT_EQ(sampleChecksum(grid),
                  crc32_z(0, reinterpret_cast<const Bytef*>(grid.rowData(0)), 300 * 200 * bytes));
        SampleGrid part = SampleGrid::create(type, 44, 50).value();
        for (std::size_t row = 0; row < 50; ++row) {
            std::memcpy(part.rowData(row), grid.rowData(150 + row) + 256 * bytes, 44 * bytes);
        }
        EXPECT_EQ(sampleChecksum(grid, {256, 150, 44, 50}), sampleChecksum(part));
    }
}

} // namespace
} // namespace marsview
