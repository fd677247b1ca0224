#include "core/sources/source_identity.h"
#include "core/sources/source_stamp.h"
#include "tests/support/make_raster.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/stat.h>
#include <vector>

namespace marsview {
namespace {

namespace fs = std::filesystem;

constexpr long kMillisecond_ns = 1'000'000;

struct stat statusOf(const std::string& path)
{
    struct stat status {};
    EXPECT_EQ(stat(path.c_str(), &status), 0);
    return status;
}

void setModified(const std::string& path, const timespec& time)
{
    const std::array<timespec, 2> times{timespec{0, UTIME_OMIT}, time};
    ASSERT_EQ(utimensat(AT_FDCWD, path.c_str(), times.data(), 0), 0);
}

// Far from the blocks that SourceIdentity reads.
void overwriteMiddle(const std::string& path)
{
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(fs::file_size(path) / 17 * 5 + 20'000));
    file << "other samples";
    ASSERT_TRUE(file.flush());
}

std::string mapOf(const test::TempFolder& folder)
{
    std::vector<std::int16_t> samples(std::size_t{1000} * 1000);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] = static_cast<std::int16_t>(i * 31 % 4001);
    }
    return test::writeVrt(folder, "map", test::recipeFor(1000, samples));
}

} // namespace

TEST(SourceStamp, DoesNotChangeWhileTheRasterIsRead)
{
    const test::TempFolder folder;
    const std::string path = mapOf(folder);
    const SourceStamp stamp = stampOf(path);
    EXPECT_EQ(stamp.files.size(), 2U);
    test::readFile(folder.file("map.raw"));
    EXPECT_TRUE(identify(path));
    EXPECT_TRUE(isUntouched(stamp));
    EXPECT_EQ(stampOf(path).text, stamp.text);
}

TEST(SourceStamp, DetectsAWriteWithinTheSameSecond)
{
    const test::TempFolder folder;
    const std::string path = mapOf(folder);
    const std::string data = folder.file("map.raw");
    setModified(data, {1'700'000'000, 20 * kMillisecond_ns});
    const SourceIdentity identity = identify(path).value();
    const SourceStamp stamp = stampOf(path);
    overwriteMiddle(data);
    setModified(data, {1'700'000'000, 600 * kMillisecond_ns});
    ASSERT_TRUE(isSameContent(identity, identify(path).value())) << "the identity differs";
    EXPECT_FALSE(isUntouched(stamp));
}

TEST(SourceStamp, DetectsAWriteWithARestoredTime)
{
    const test::TempFolder folder;
    const std::string path = mapOf(folder);
    const std::string data = folder.file("map.raw");
    const struct stat before = statusOf(data);
    const SourceStamp stamp = stampOf(path);
    do { // until the clock of the file system has advanced
        overwriteMiddle(data);
        setModified(data, before.st_mtim);
    } while (statusOf(data).st_ctim.tv_nsec == before.st_ctim.tv_nsec);
    ASSERT_EQ(statusOf(data).st_mtim.tv_nsec, before.st_mtim.tv_nsec);
    EXPECT_FALSE(isUntouched(stamp));
}

TEST(SourceStamp, DetectsAReplacedFile)
{
    const test::TempFolder folder;
    const std::string path = mapOf(folder);
    const std::string data = folder.file("map.raw");
    const SourceStamp stamp = stampOf(path);
    fs::copy_file(data, folder.file("other"));
    setModified(folder.file("other"), statusOf(data).st_mtim);
    fs::rename(folder.file("other"), data);
    EXPECT_FALSE(isUntouched(stamp));
    fs::remove(data);
    EXPECT_FALSE(isUntouched(stamp));
}

TEST(SourceStamp, IsThatOfTheArchiveForAMember)
{
    const test::TempFolder folder;
    const std::string tif = test::writeRaster(folder, "map.tif", "GTiff",
                                              test::recipeFor<std::int16_t>(2, {1, 2, 3, 4}));
    const std::string archive = folder.file("map.tif.gz");
    test::runTool({"gzip", "-k", tif});
    for (const std::string& name : {"/vsigzip/" + archive, "/vsigzip/{" + archive + "}"}) {
        setModified(archive, {1'700'000'000, 0});
        const SourceStamp stamp = stampOf(name);
        EXPECT_FALSE(stamp.text.empty()) << name;
        EXPECT_TRUE(isUntouched(stamp)) << name;
        setModified(archive, {1'700'000'000, 5});
        EXPECT_FALSE(isUntouched(stamp)) << name;
    }
    setModified(tif, {1'700'000'000, 0});
    const SourceStamp part = stampOf("/vsisubfile/0_100," + tif);
    EXPECT_FALSE(part.text.empty());
    setModified(tif, {1'700'000'000, 5});
    EXPECT_FALSE(isUntouched(part));
}

TEST(SourceStamp, IsEmptyForFilesThatAreNotOnADisk)
{
    const SourceStamp stamp = stampOf("http://localhost:1/mars.tif");
    EXPECT_TRUE(stamp.files.empty());
    EXPECT_TRUE(stamp.text.empty());
    EXPECT_TRUE(isUntouched(stamp));
}

} // namespace marsview
