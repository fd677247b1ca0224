#include "core/sources/source_identity.h"
#include "tests/support/make_raster.h"
#include "tests/support/random.h"
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

namespace marsview {
namespace {

namespace fs = std::filesystem;

SourceIdentity identityOf(const std::string& path)
{
    Result<SourceIdentity> identity = identify(path);
    EXPECT_TRUE(identity) << identity.error().message;
    return identity ? *identity : SourceIdentity{};
}

// Changes a byte without changing size or time.
void changeByte(const std::string& path, std::uint64_t offset)
{
    const fs::file_time_type time = fs::last_write_time(path);
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(offset));
    const int byte = file.get();
    file.seekp(static_cast<std::streamoff>(offset));
    file.put(static_cast<char>(byte ^ 1));
    file.close();
    ASSERT_TRUE(file);
    fs::last_write_time(path, time);
}

std::string bigFile(const test::TempFolder& folder)
{
    test::Random random;
    std::string content(3'000'000, '\0');
    for (char& c : content) {
        c = static_cast<char>(random.bits() & 0xFFU);
    }
    return folder.write("big.bin", content);
}

} // namespace

TEST(SourceIdentity, DoesNotChangeWithoutAWrite)
{
    const test::TempFolder folder;
    const std::string path = bigFile(folder);
    const SourceIdentity first = identityOf(path);
    EXPECT_EQ(first, identityOf(path));
    EXPECT_EQ(first.bytes, 3'000'000U);
    EXPECT_EQ(first.path, path);
    EXPECT_EQ(first.digest.size(), 16U);
}

TEST(SourceIdentity, FollowsAFileThatMoves)
{
    const test::TempFolder folder;
    const std::string path = bigFile(folder);
    const SourceIdentity before = identityOf(path);
    fs::rename(path, folder.file("moved.bin"));
    const SourceIdentity after = identityOf(folder.file("moved.bin"));
    EXPECT_TRUE(isSameContent(before, after));
    EXPECT_NE(before.path, after.path);
}

TEST(SourceIdentity, DetectsChangesAtHeadAndTailAndThroughoutTheFile)
{
    const test::TempFolder folder;
    const std::string path = bigFile(folder);
    const SourceIdentity before = identityOf(path);
    // The blocks are at multiples of a seventeenth of the file.
    for (const std::uint64_t offset :
         {std::uint64_t{0}, std::uint64_t{65'535}, std::uint64_t{3'000'000 / 17 * 9 + 100},
          std::uint64_t{3'000'000 - 65'536}, std::uint64_t{2'999'999}}) {
        SCOPED_TRACE(offset);
        changeByte(path, offset);
        EXPECT_FALSE(isSameContent(before, identityOf(path)));
        changeByte(path, offset);
        EXPECT_TRUE(isSameContent(before, identityOf(path)));
    }
}

TEST(SourceIdentity, DetectsATouchedAndAGrownFile)
{
    const test::TempFolder folder;
    const std::string path = bigFile(folder);
    const SourceIdentity before = identityOf(path);
    const fs::file_time_type time = fs::last_write_time(path);
    fs::last_write_time(path, time + std::chrono::seconds(2));
    EXPECT_FALSE(isSameContent(before, identityOf(path)));
    std::ofstream(path, std::ios::app | std::ios::binary) << 'x';
    fs::last_write_time(path, time);
    EXPECT_FALSE(isSameContent(before, identityOf(path)));
}

TEST(SourceIdentity, DetectsAChangeOfAHeadersData)
{
    const test::TempFolder folder;
    std::vector<std::int16_t> samples(200 * 300);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] = static_cast<std::int16_t>(i % 1000);
    }
    const std::string vrt = test::writeVrt(folder, "map", test::recipeFor(200, samples));
    const SourceIdentity before = identityOf(vrt);
    EXPECT_GT(before.bytes, samples.size() * 2);
    changeByte(folder.file("map.raw"), 1000);
    EXPECT_FALSE(isSameContent(before, identityOf(vrt)));
}

TEST(SourceIdentity, DetectsAChangeOfALabelsImage)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    const test::TempFolder folder;
    for (const char* name : {"megt90n000cb.lbl", "megt90n000cb.img"}) {
        const fs::path from = test::sharedData() / "mars_mola" / name;
        if (fs::exists(from)) {
            folder.write(name, test::readFile(from));
        }
    }
    const std::string label = folder.file("megt90n000cb.lbl");
    const SourceIdentity before = identityOf(label);
    EXPECT_GT(before.bytes, 2'000'000U);
    changeByte(folder.file("megt90n000cb.img"), 10);
    EXPECT_FALSE(isSameContent(before, identityOf(label)));
}

TEST(SourceIdentity, DetectsAChangeOfAHeaderInCapitals)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    const test::TempFolder folder;
    for (const char* name : {"W100N40_etopo5.DEM", "W100N40_etopo5.HDR"}) {
        folder.write(name, test::readFile(test::sharedData() / "derived" / name));
    }
    const std::string path = folder.file("W100N40_etopo5.DEM");
    const SourceIdentity before = identityOf(path);
    changeByte(folder.file("W100N40_etopo5.HDR"), 300);
    EXPECT_FALSE(isSameContent(before, identityOf(path)));
}

TEST(SourceIdentity, IgnoresStatisticsNextToTheRaster)
{
    const test::TempFolder folder;
    const std::string path = test::writeRaster(folder, "map.tif", "GTiff",
                                               test::recipeFor<std::int16_t>(2, {1, 2, 3, 4}));
    const SourceIdentity before = identityOf(path);
    folder.write("map.tif.aux.xml",
                 "<PAMDataset><PAMRasterBand band=\"1\"><Description>x</Description>"
                 "</PAMRasterBand></PAMDataset>");
    EXPECT_TRUE(isSameContent(before, identityOf(path)));
}

TEST(SourceIdentity, IncludesOverviewsNextToTheRasterIfTheyAreRead)
{
    const test::TempFolder folder;
    std::vector<std::int16_t> samples(64 * 64);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] = static_cast<std::int16_t>(i * i % 1000);
    }
    const std::string path =
        test::writeRaster(folder, "map.tif", "GTiff", test::recipeFor<std::int16_t>(64, samples));
    const auto of = [&path](OverviewFiles overviews) { return identify(path, overviews).value(); };
    const SourceIdentity without = of(OverviewFiles::Counted);
    EXPECT_EQ(without, of(OverviewFiles::Ignored));
    test::runTool({"gdaladdo", "-q", "-ro", "-r", "average", path, "2"});
    const SourceIdentity averages = of(OverviewFiles::Counted);
    EXPECT_FALSE(isSameContent(without, averages));
    EXPECT_TRUE(isSameContent(without, of(OverviewFiles::Ignored)));
    const fs::file_time_type time = fs::last_write_time(path + ".ovr");
    fs::remove(path + ".ovr");
    test::runTool({"gdaladdo", "-q", "-ro", "-r", "nearest", path, "2"});
    fs::last_write_time(path + ".ovr", time);
    EXPECT_FALSE(isSameContent(averages, of(OverviewFiles::Counted)));
    EXPECT_TRUE(isSameContent(without, of(OverviewFiles::Ignored)));
}

TEST(SourceIdentity, ReadsGdalsFileSystems)
{
    const test::TempFolder folder;
    const std::string path = bigFile(folder);
    const SourceIdentity plain = identityOf(path);
    const SourceIdentity part = identityOf("/vsisubfile/1000_100000," + path);
    EXPECT_EQ(part.bytes, 100'000U);
    EXPECT_NE(part.digest, plain.digest);
    EXPECT_EQ(part.path, "/vsisubfile/1000_100000," + path);
}

TEST(SourceIdentity, NamesAMissingFile)
{
    const test::TempFolder folder;
    const std::string path = folder.file("nothing.tif");
    const Result<SourceIdentity> missing = identify(path);
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::NotFound);
    EXPECT_TRUE(missing.error().message.starts_with(path)) << missing.error().message;
    EXPECT_FALSE(identify(""));
    EXPECT_FALSE(identify(folder.path().string()));
}

} // namespace marsview
