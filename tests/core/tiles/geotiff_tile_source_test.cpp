// Tiles of a damaged prepared map.
#include "core/prepare/tiled_geotiff.h"
#include "core/tiles/geotiff_tile_source.h"
#include "tests/support/make_raster.h"
#include "tests/support/make_terrain.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace marsview {
namespace {

struct Size {
    std::size_t columns;
    std::size_t rows;
};

std::vector<TileId> allTiles(const TileLayout& layout)
{
    std::vector<TileId> ids;
    const auto add = [&](TileKind kind, std::size_t level) {
        for (std::uint32_t row = 0; row < layout.tileRows(kind, level); ++row) {
            for (std::uint32_t column = 0; column < layout.tileColumns(kind, level); ++column) {
                ids.push_back({kind, static_cast<std::uint8_t>(level), column, row});
            }
        }
    };
    for (std::size_t level = 0; level <= GeotiffTileSource::kLastLevel; ++level) {
        add(TileKind::Samples, level);
    }
    for (std::size_t level = 1; level <= layout.mean_levels; ++level) {
        add(TileKind::Means, level);
    }
    return ids;
}

bool isSame(const SampleGrid& a, const SampleGrid& b)
{
    return a.columns() == b.columns() && a.rows() == b.rows() && a.visit([&](auto view) {
        return std::memcmp(view.data(),
                           b.visit([](auto other) -> const void* { return other.data(); }),
                           a.columns() * a.rows() * sizeof(*view.data())) == 0;
    });
}

class CheckedTiles : public testing::TestWithParam<Size> {
protected:
    void SetUp() override
    {
        const auto [columns, rows] = GetParam();
        test::Random random;
        const auto heights = test::fractalHeights(random, columns, rows, 900.0, 0.6);
        std::vector<std::int16_t> samples;
        for (const double height : heights) {
            samples.push_back(static_cast<std::int16_t>(std::lrint(height)));
        }
        TiledGeoTiffJob job;
        job.source = test::writeVrt(folder_, "source", test::recipeFor(columns, samples));
        job.path = folder_.file("map.tif");
        JobMonitor monitor;
        ASSERT_TRUE(writeTiledGeoTiff(job, monitor));
        bytes_ = test::readFile(job.path);
        source_ = opened(job.path);
        ASSERT_NE(source_, nullptr);
        auto checksums = std::make_shared<TileChecksums>(source_->layout());
        const auto reader = source_->open().value();
        for (const TileId& id : allTiles(source_->layout())) {
            truth_.push_back(reader->read(id).value().samples);
            if (TileChecksums::covers(id)) {
                checksums->set(id, sampleChecksum(truth_.back()));
            }
        }
        checksums_ = std::move(checksums);
    }

    static std::shared_ptr<const GeotiffTileSource> opened(const std::string& path)
    {
        const Result<RasterFile> file = RasterFile::open(path, 1);
        if (!file) {
            return nullptr;
        }
        auto source = GeotiffTileSource::of(*file, {});
        return source ? *source : nullptr;
    }

    test::TempFolder folder_;
    std::string bytes_; // of the prepared file
    std::shared_ptr<const GeotiffTileSource> source_;
    std::shared_ptr<const TileChecksums> checksums_;
    std::vector<SampleGrid> truth_; // of allTiles()
};

TEST_P(CheckedTiles, MatchTheRasterAtEveryLevel)
{
    const auto reader = source_->checkedBy(checksums_)->open().value();
    const std::vector<TileId> ids = allTiles(source_->layout());
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const Result<Tile> tile = reader->read(ids[i]);
        ASSERT_TRUE(tile) << tile.error().message;
        EXPECT_TRUE(isSame(tile->samples, truth_[i])) << int{ids[i].level} << ": " << ids[i].column;
    }
}

TEST_P(CheckedTiles, AreErrorsNotWrongHeightsIfTheFileIsDamaged)
{
    test::Random random;
    const std::vector<TileId> ids = allTiles(source_->layout());
    std::size_t refused = 0;
    std::size_t silent = 0; // damage that only checksums reveal
    for (int round = 0; round < 60; ++round) {
        std::string damaged = bytes_;
        const std::size_t count = 1 + random.below(40);
        const std::size_t at = bytes_.size() / 10 + random.below(bytes_.size() * 9 / 10 - count);
        for (std::size_t i = 0; i < count; ++i) {
            damaged[at + i] = static_cast<char>(random.bits());
        }
        const auto source = opened(folder_.write("damaged.tif", damaged));
        if (source == nullptr || source->layout().mean_levels != source_->layout().mean_levels) {
            continue; // it no longer opens as the prepared map
        }
        const auto plain = source->open();
        const auto checked = source->checkedBy(checksums_)->open();
        if (!plain || !checked) {
            continue;
        }
        for (std::size_t i = 0; i < ids.size(); ++i) {
            const Result<Tile> tile = (*checked)->read(ids[i]);
            if (tile) {
                EXPECT_TRUE(isSame(tile->samples, truth_[i]))
                    << "byte " << at << ", tile " << ids[i].column << ", " << ids[i].row;
                continue;
            }
            ++refused;
            EXPECT_EQ(tile.error().code, ErrorCode::Unreadable);
            const Result<Tile> unchecked = (*plain)->read(ids[i]);
            silent += unchecked && !isSame(unchecked->samples, truth_[i]) ? 1U : 0U;
        }
    }
    EXPECT_GT(refused, 20U);
    RecordProperty("silent", std::to_string(silent));
    EXPECT_GT(silent, 0U) << "none of the damage needs checksums";
}

// Sizes at which the last sample of a level is alone in its tile.
INSTANTIATE_TEST_SUITE_P(Sizes,
                         CheckedTiles,
                         testing::Values(Size{700, 600}, Size{512, 513}, Size{1026, 769}));

} // namespace
} // namespace marsview
