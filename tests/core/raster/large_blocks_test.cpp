// Rasters in large blocks: the same samples as from GDAL's tools, without a whole block in memory.
#include "core/prepare/tiled_geotiff.h"
#include "core/raster/raster_file.h"
#include "tests/support/make_raster.h"
#include "tests/support/random.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string>
#include <unistd.h>
#include <vector>

namespace marsview {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

// 18 MB of int16, one and a half million of which differ from the value that a plain predictor
// expects.
constexpr std::size_t kColumns = 3000;
constexpr std::size_t kRows = 3001;

template <typename T>
std::vector<T> noise()
{
    test::Random random;
    std::vector<T> samples(kColumns * kRows);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] = static_cast<T>(i / 7 % 90 + (i % 6 == 0 ? random.below(31) : 0U));
    }
    return samples;
}

template <typename T>
bool isEqual(const LoadedSamples& loaded, const std::vector<T>& truth, const GridWindow& window)
{
    for (std::size_t row = 0; row < window.rows; ++row) {
        const T* from = truth.data() + (window.row + row) * kColumns + window.column;
        const bool is_same = loaded.grid.visit([&](auto view) {
            return std::memcmp(view.row(row).data(), from, window.columns * sizeof(T)) == 0;
        });
        if (!is_same) {
            return false;
        }
    }
    return true;
}

class LargeBlocksTest : public testing::Test {
protected:
    template <typename T>
    std::string write(const std::vector<T>& samples, std::vector<std::string> options) const
    {
        std::vector<std::string> all;
        for (std::string& option : options) {
            all.emplace_back("-co");
            all.push_back(std::move(option));
        }
        return test::writeRaster(folder_, "map.tif", "GTiff", test::recipeFor(kColumns, samples),
                                 all);
    }

    test::TempFolder folder_;
};

template <typename T>
void expectAllReads(const std::string& path, const std::vector<T>& truth)
{
    Result<RasterFile> file = RasterFile::open(path);
    ASSERT_TRUE(file) << file.error().message;
    // In order, back to the start, across strip boundaries, parts of rows, and the end.
    for (const GridWindow& window :
         {GridWindow{0, 0, kColumns, 10}, GridWindow{0, 10, kColumns, 1},
          GridWindow{0, 700, kColumns, 200}, GridWindow{0, 3, kColumns, 2},
          GridWindow{17, 1500, 40, 30}, GridWindow{0, 2990, kColumns, 11},
          GridWindow{0, 2990, kColumns, 11}, GridWindow{0, 0, kColumns, kRows}}) {
        const auto loaded = file->readWindow(window, {});
        ASSERT_TRUE(loaded) << loaded.error().message;
        EXPECT_TRUE(isEqual(*loaded, truth, window)) << window.column << " " << window.row;
    }
    JobMonitor monitor;
    const auto all = file->readAll(monitor, {}, std::size_t{1} << 30);
    ASSERT_TRUE(all) << all.error().message;
    EXPECT_TRUE(isEqual(*all, truth, {0, 0, kColumns, kRows}));
}

TEST_F(LargeBlocksTest, CompressedStripsReadBackTheWrittenSamples)
{
    const auto integers = noise<std::int16_t>();
    for (const char* compression : {"DEFLATE", "LZW", "ZSTD", "PACKBITS"}) {
        for (const char* rows : {"3001", "2900"}) { // one strip; two
            SCOPED_TRACE(std::string(compression) + " " + rows);
            expectAllReads(write(integers, {std::string("COMPRESS=") + compression,
                                            std::string("BLOCKYSIZE=") + rows}),
                           integers);
        }
    }
    expectAllReads(write(integers, {"COMPRESS=DEFLATE", "BLOCKYSIZE=3001", "PREDICTOR=2"}),
                   integers);
    expectAllReads(write(integers, {"COMPRESS=LZW", "BLOCKYSIZE=3001", "ENDIANNESS=BIG"}),
                   integers);
    const auto floats = noise<float>();
    expectAllReads(write(floats, {"COMPRESS=DEFLATE", "BLOCKYSIZE=3001", "PREDICTOR=3"}), floats);
}

TEST_F(LargeBlocksTest, OmittedStripsReadAsZeros)
{
    auto samples = noise<std::int16_t>();
    std::fill(samples.begin() + static_cast<std::ptrdiff_t>(kColumns * 2900), samples.end(), 0);
    expectAllReads(write(samples, {"COMPRESS=DEFLATE", "BLOCKYSIZE=2900", "SPARSE_OK=TRUE"}),
                   samples);
}

TEST_F(LargeBlocksTest, UncompressedStripsReadBackTheWrittenSamples)
{
    const auto samples = noise<std::int16_t>();
    for (const char* rows : {"3001", "2900"}) {
        for (const char* endianness : {"LITTLE", "BIG"}) {
            SCOPED_TRACE(std::string(rows) + " " + endianness);
            expectAllReads(write(samples, {std::string("BLOCKYSIZE=") + rows,
                                           std::string("ENDIANNESS=") + endianness}),
                           samples);
        }
    }
}

TEST_F(LargeBlocksTest, ReadsRowsWithoutKeepingBlocks)
{
    const auto samples = noise<std::int16_t>();
    const auto has_cheap_rows = [&](const std::vector<std::string>& options) {
        const auto file = RasterFile::open(write(samples, options));
        EXPECT_TRUE(file);
        return file->hasCheapRows();
    };
    EXPECT_TRUE(has_cheap_rows({"COMPRESS=DEFLATE", "BLOCKYSIZE=3001"}));
    EXPECT_TRUE(has_cheap_rows({"BLOCKYSIZE=2900"}));
    EXPECT_FALSE(has_cheap_rows({"COMPRESS=DEFLATE", "BLOCKYSIZE=64"})) << "blocks are small";
    EXPECT_FALSE(
        has_cheap_rows({"COMPRESS=DEFLATE", "TILED=YES", "BLOCKXSIZE=3008", "BLOCKYSIZE=3008"}));
}

TEST_F(LargeBlocksTest, ReadsAnyBand)
{
    const auto samples = noise<std::int16_t>();
    test::RasterRecipe recipe = test::recipeFor(kColumns, samples);
    const std::string one = test::writeRaster(folder_, "one.tif", "GTiff", recipe);
    std::vector<std::int16_t> other = samples;
    std::reverse(other.begin(), other.end());
    recipe.extra_xml =
        "<VRTRasterBand dataType=\"Int16\" band=\"2\"><SimpleSource>"
        "<SourceFilename>" +
        test::writeRaster(folder_, "two.tif", "GTiff", test::recipeFor(kColumns, other)) +
        "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand>";
    for (const char* interleave : {"INTERLEAVE=BAND", "INTERLEAVE=PIXEL"}) {
        const std::string path = test::writeRaster(
            folder_, "both.tif", "GTiff", recipe,
            {"-co", "COMPRESS=DEFLATE", "-co", "BLOCKYSIZE=3001", "-co", interleave});
        Result<RasterFile> file = RasterFile::open(path, 2);
        ASSERT_TRUE(file) << file.error().message;
        for (const GridWindow& window :
             {GridWindow{0, 400, kColumns, 100}, GridWindow{0, 100, kColumns, 100}}) {
            const auto loaded = file->readWindow(window, {});
            ASSERT_TRUE(loaded) << loaded.error().message;
            EXPECT_TRUE(isEqual(*loaded, other, window)) << interleave;
        }
    }
}

TEST_F(LargeBlocksTest, ATruncatedStripIsAnErrorNotAHeight)
{
    const auto samples = noise<std::int16_t>();
    const std::string path = write(samples, {"COMPRESS=DEFLATE", "BLOCKYSIZE=3001"});
    Result<RasterFile> file = RasterFile::open(path);
    ASSERT_TRUE(file);
    const GridWindow begin{0, 0, kColumns, 100};
    const GridWindow end{0, kRows - 100, kColumns, 100};
    ASSERT_TRUE(file->readWindow(begin, {}));
    // For a file that is already open, and for one that is opened now.
    ASSERT_EQ(truncate(path.c_str(), static_cast<off_t>(fs::file_size(path) / 2)), 0);
    Result<RasterFile> again = RasterFile::open(path);
    for (RasterFile* reader : {&*file, again ? &*again : nullptr}) {
        if (reader == nullptr) {
            continue;
        }
        for (const GridWindow& window : {end, begin}) {
            const auto loaded = reader->readWindow(window, {});
            if (loaded) {
                EXPECT_TRUE(isEqual(*loaded, samples, window));
                continue;
            }
            EXPECT_THAT(loaded.error().message, HasSubstr(path + ": "));
        }
    }
    JobMonitor monitor;
    const auto all = file->readAll(monitor, {}, std::size_t{1} << 30);
    ASSERT_FALSE(all);
    EXPECT_THAT(all.error().message, HasSubstr(path + ": "));
}

TEST_F(LargeBlocksTest, OnlyVeryLargeBlocksCauseANotice)
{
    const auto samples = noise<std::int16_t>();
    const auto notices_of = [](const std::string& path) {
        const auto file = RasterFile::open(path);
        EXPECT_TRUE(file) << file.error().message;
        return file ? file->info().notices : std::vector<std::string>{};
    };
    const std::string strip = write(samples, {"COMPRESS=DEFLATE", "BLOCKYSIZE=3001"});
    EXPECT_THAT(notices_of(strip), Not(Contains(HasSubstr("GB of memory"))));
    // 12000 × 12000 samples, 288 MB, almost none of them stored on disk.
    test::RasterRecipe recipe = test::recipeFor(kColumns, samples);
    const std::string large = test::writeRaster(
        folder_, "large.tif", "GTiff", recipe,
        {"-outsize", "12000", "12000", "-co", "COMPRESS=ZSTD", "-co", "BLOCKYSIZE=12000"});
    EXPECT_THAT(notices_of(large),
                Contains(AllOf(HasSubstr("is stored in blocks of 12000 × 12000 samples"),
                               HasSubstr("up to 0."), HasSubstr("TILED=YES"))));
}

} // namespace
} // namespace marsview
