#include "core/files/tiff_size_check.h"
#include "tests/support/make_raster.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace marsview {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class TiffPromiseTest : public testing::Test {
protected:
    std::string write(const std::vector<std::string>& creation_options) const
    {
        std::vector<std::int16_t> samples(std::size_t{500} * 300);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            samples[i] = static_cast<std::int16_t>(i * 31 % 1009);
        }
        std::vector<std::string> options;
        for (const std::string& option : creation_options) {
            options.insert(options.end(), {"-co", option});
        }
        return test::writeRaster(folder_, "map.tif", "GTiff", test::recipeFor(500, samples),
                                 options);
    }

    test::TempFolder folder_;
};

TEST_F(TiffPromiseTest, AcceptsFilesWrittenByGdal)
{
    const std::vector<std::vector<std::string>> layouts{
        {},
        {"BIGTIFF=YES"},
        {"ENDIANNESS=BIG"},
        {"ENDIANNESS=BIG", "BIGTIFF=YES", "TILED=YES"},
        {"TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16", "COMPRESS=LZW"},
        {"COMPRESS=DEFLATE", "BLOCKYSIZE=300", "PREDICTOR=2"},
        {"COMPRESS=PACKBITS", "BLOCKYSIZE=7"},
        {"COMPRESS=ZSTD", "TILED=YES"},
        {"NBITS=12"},
        {"SPARSE_OK=TRUE", "TILED=YES"},
    };
    for (const auto& options : layouts) {
        SCOPED_TRACE(testing::PrintToString(options));
        const auto promise = tiffSizesOf(write(options));
        ASSERT_TRUE(promise);
        EXPECT_TRUE(promise->fits) << promise->fits.error().message;
        EXPECT_TRUE(promise->is_plain);
    }
    const auto picture = tiffSizesOf(write({"COMPRESS=LERC"}));
    ASSERT_TRUE(picture);
    EXPECT_TRUE(picture->fits);
    EXPECT_FALSE(picture->is_plain);
}

// The smallest deflate and LZW files possible for many samples.
TEST_F(TiffPromiseTest, AcceptsHighlyCompressedFlatMaps)
{
    for (const char* compression : {"DEFLATE", "LZW", "PACKBITS", "ZSTD"}) {
        const std::string path = test::writeRaster(
            folder_, "flat.tif", "GTiff", test::recipeFor(2, std::vector<std::int16_t>(4, 0)),
            {"-outsize", "8000", "8000", "-co", std::string("COMPRESS=") + compression, "-co",
             "BLOCKYSIZE=8000"});
        const auto promise = tiffSizesOf(path);
        ASSERT_TRUE(promise);
        EXPECT_TRUE(promise->fits) << promise->fits.error().message;
    }
}

TEST_F(TiffPromiseTest, RefusesTruncatedFiles)
{
    for (const auto& options : std::vector<std::vector<std::string>>{
             {}, {"BIGTIFF=YES"}, {"TILED=YES", "COMPRESS=DEFLATE"}, {"ENDIANNESS=BIG"}}) {
        const std::string path = write(options);
        const std::uintmax_t whole = fs::file_size(path);
        for (const std::uintmax_t bytes : {whole - whole / 8, whole / 2, std::uintmax_t{60}}) {
            SCOPED_TRACE(bytes);
            fs::resize_file(path, bytes);
            const auto promise = tiffSizesOf(path);
            ASSERT_TRUE(promise);
            ASSERT_FALSE(promise->fits);
            EXPECT_THAT(promise->fits.error().message, HasSubstr("is cut short or damaged: "));
        }
    }
}

TEST_F(TiffPromiseTest, OtherFilesAreNotTiffs)
{
    EXPECT_FALSE(tiffSizesOf(folder_.write("text.tif", "II is not enough")));
    EXPECT_FALSE(tiffSizesOf(folder_.write("short.tif", "II*")));
    EXPECT_FALSE(tiffSizesOf(folder_.file("missing.tif")));
}

TEST_F(TiffPromiseTest, AcceptsRealFiles)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(test::sharedData())) {
        if (entry.path().extension() != ".tif" ||
            entry.path().filename().string().find("truncated") != std::string::npos) {
            continue;
        }
        SCOPED_TRACE(entry.path());
        const auto promise = tiffSizesOf(entry.path().string());
        ASSERT_TRUE(promise);
        EXPECT_TRUE(promise->fits) << promise->fits.error().message;
    }
}

} // namespace
} // namespace marsview
