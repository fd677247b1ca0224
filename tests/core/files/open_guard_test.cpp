// Opening in a child process, as RasterFile does. Faulty drivers are tested in
// tests/cli/hostile_files_test.cpp.
#include "core/files/block_cache.h"
#include "core/files/opening_job.h"
#include "core/raster/raster_file.h"
#include "tests/support/make_raster.h"
#include "tests/support/scoped_variable.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace marsview {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class OpenGuardTest : public testing::Test {
protected:
    bool remembersSomething() const
    {
        return fs::exists(folder_.file("cache/opened")) &&
               !fs::is_empty(folder_.file("cache/opened"));
    }
    std::string write(const std::string& file, const std::string& format) const
    {
        return test::writeRaster(folder_, file, format,
                                 test::recipeFor<std::int16_t>(3, {1, 2, 3, 4, 5, 6, 7, 8, 9}));
    }

    test::TempFolder folder_;
    const test::ScopedVariable cache_{"MARSVIEW_CACHE_DIR", folder_.file("cache").c_str()};
    const test::ScopedVariable drivers_{"GDAL_DRIVER_PATH", MARSVIEW_TEST_GDAL_DRIVERS};
};

TEST_F(OpenGuardTest, PlainFilesAreOpenedWithoutAChild)
{
    for (const auto& [file, format] :
         std::vector<std::pair<std::string, std::string>>{{"map.tif", "GTiff"},
                                                          {"map.asc", "AAIGrid"},
                                                          {"map.bil", "EHdr"},
                                                          {"map.dat", "ENVI"},
                                                          {"map.cub", "ISIS3"},
                                                          {"map.vic", "VICAR"}}) {
        const auto opened = RasterFile::open(write(file, format));
        ASSERT_TRUE(opened) << opened.error().message;
        EXPECT_EQ(opened->info().driver, format);
        EXPECT_FALSE(remembersSomething()) << format;
    }
}

TEST_F(OpenGuardTest, OtherFilesAreProbedInAChildOnce)
{
    const std::string path = write("map.img", "HFA");
    for (int i = 0; i < 2; ++i) {
        auto opened = RasterFile::open(path);
        ASSERT_TRUE(opened) << opened.error().message;
        EXPECT_EQ(opened->info().driver, "HFA");
        EXPECT_TRUE(remembersSomething());
        EXPECT_EQ(opened->readWindow({2, 2, 1, 1}, {})->grid.raw(0, 0), 9.0);
    }
}

TEST_F(OpenGuardTest, ARasterIsProbedAgainWhenFilesThatItNamesChange)
{
    const std::string source = write("map.img", "HFA");
    const std::string path =
        folder_.write("map.vrt",
                      "<VRTDataset rasterXSize=\"3\" rasterYSize=\"3\"><VRTRasterBand "
                      "dataType=\"Int16\" band=\"1\"><SimpleSource><SourceFilename "
                      "relativeToVRT=\"1\">map.img</SourceFilename></SimpleSource></VRTRasterBand>"
                      "</VRTDataset>");
    ASSERT_TRUE(RasterFile::open(path));
    folder_.write("map.img", "FAULTY crash\n");
    const auto opened = RasterFile::open(path);
    ASSERT_FALSE(opened);
    EXPECT_THAT(opened.error().message, HasSubstr("crashed on this file"));
}

TEST_F(OpenGuardTest, AFileIsNotBlamedForAChildThatIsEndedFromOutside)
{
    const std::string path = folder_.write("map.faulty", "FAULTY killed\n");
    const auto opened = RasterFile::open(path);
    ASSERT_FALSE(opened);
    EXPECT_THAT(opened.error().message, HasSubstr("ended from outside"));
    EXPECT_FALSE(remembersSomething());

    folder_.write("map.faulty", "FAULTY crash\n");
    const auto crashed = RasterFile::open(path);
    ASSERT_FALSE(crashed);
    EXPECT_THAT(crashed.error().message, HasSubstr("the FAULTY driver of GDAL crashed"));
    EXPECT_TRUE(remembersSomething());
}

TEST_F(OpenGuardTest, CancelingEndsTheChild)
{
    const std::string path = folder_.write("map.faulty", "FAULTY hang\n");
    JobMonitor monitor;
    ErrorCode code = ErrorCode::Invalid;
    std::jthread opener([&] {
        const OpeningJob job(&monitor);
        const auto opened = RasterFile::open(path);
        code = opened ? ErrorCode::Invalid : opened.error().code;
    });
    monitor.cancel();
    opener.join();
    EXPECT_EQ(code, ErrorCode::Canceled);
}

// Settings are read once per process, so each case has its own process.
TEST(BlockCacheTest, KeepsTheUsersSettings)
{
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const test::TempFolder folder;
    const std::string file = folder.write("gdalrc", "[configoptions]\nGDAL_CACHEMAX=66\n");
    const auto cache_mb = [](const char* variable, const std::string& value) {
        setenv(variable, value.c_str(), 1); // NOLINT
        std::exit(static_cast<int>(blockCacheBytes() >> 20));
    };
    EXPECT_EXIT(cache_mb("GDAL_CACHEMAX", "77"), testing::ExitedWithCode(77), "");
    EXPECT_EXIT(cache_mb("GDAL_CONFIG_FILE", file), testing::ExitedWithCode(66), "");
    EXPECT_EXIT(cache_mb("UNRELATED", "1"), testing::ExitedWithCode(32), "");
}

} // namespace
} // namespace marsview
