// Files that make a reader crash, hang or run out of memory: each gives a one-line error, or opens.
#include "tests/cli/run_cli.h"
#include "tests/support/make_raster.h"
#include "tests/support/random.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace marsview {
namespace {

namespace fs = std::filesystem;
using test::ProgramOutput;
using testing::AllOf;
using testing::AnyOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

std::string bytesOf(std::uint64_t value, std::size_t count)
{
    std::string bytes;
    for (std::size_t i = 0; i < count; ++i) {
        bytes += static_cast<char>(value >> (8 * i) & 0xff);
    }
    return bytes;
}

struct TiffEntry {
    std::uint16_t tag;
    std::uint16_t type;
    std::uint32_t count;
    std::uint32_t value;
};

constexpr std::uint16_t kShort = 3;
constexpr std::uint16_t kLong = 4;

// A classic TIFF with one directory.
std::string tiffOf(const std::vector<TiffEntry>& entries, std::uint32_t next = 0)
{
    std::string bytes = "II*" + bytesOf(0, 1) + bytesOf(8, 4) + bytesOf(entries.size(), 2);
    for (const TiffEntry& entry : entries) {
        bytes += bytesOf(entry.tag, 2) + bytesOf(entry.type, 2) + bytesOf(entry.count, 4) +
                 bytesOf(entry.value, 4);
    }
    return bytes + bytesOf(next, 4);
}

// The same as GDAL's own test file many_blocks_truncated.tif: a raster with 16 million strips.
std::string manyBlocks(std::uint32_t listed, std::uint32_t offsets_at)
{
    constexpr std::uint32_t kRows = 1U << 24U;
    return tiffOf({{256, kLong, 1, 64},
                   {257, kLong, 1, kRows},
                   {258, kShort, 1, 8},
                   {259, kShort, 1, 1},
                   {262, kShort, 1, 1},
                   {273, kLong, listed, offsets_at},
                   {277, kShort, 1, 1},
                   {278, kLong, 1, 1},
                   {279, kLong, listed, offsets_at}});
}

class HostileFiles : public testing::Test {
protected:
    std::string faulty(const std::string& fault) const
    {
        return folder_.write(fault + ".faulty", "FAULTY " + fault + "\n" + std::string(100, '.'));
    }
    ProgramOutput info(const std::string& path, const std::vector<std::string>& options = {}) const
    {
        std::vector<std::string> arguments{"info", path};
        arguments.insert(arguments.end(), options.begin(), options.end());
        std::vector<std::string> environment{"MARSVIEW_CACHE_DIR=" + folder_.file("cache"),
                                             "GDAL_DRIVER_PATH=" MARSVIEW_TEST_GDAL_DRIVERS};
        environment.insert(environment.end(), environment_.begin(), environment_.end());
        return test::runCliWith(environment, arguments);
    }
    static void expectOneLine(const ProgramOutput& output, const std::string& path)
    {
        EXPECT_EQ(output.exit_status, 1) << output.err;
        EXPECT_THAT(output.out, IsEmpty());
        EXPECT_THAT(output.err, StartsWith("marsview-cli: " + path + ": "));
        EXPECT_EQ(std::count(output.err.begin(), output.err.end(), '\n'), 1) << output.err;
        EXPECT_THAT(output.err, EndsWith("\n"));
    }

    test::TempFolder folder_;
    std::vector<std::string> environment_;
};

TEST_F(HostileFiles, ReportsACrashInOneLineWithDriverAndFile)
{
    for (const char* fault : {"crash", "overflow", "crash while reading",
                              "crash while reading slowly", "crash while closing"}) {
        SCOPED_TRACE(fault);
        const std::string path = faulty(fault);
        const ProgramOutput output = info(path);
        expectOneLine(output, path);
        EXPECT_THAT(output.err, HasSubstr("the FAULTY driver of GDAL crashed on this file"));
    }
}

// A virtual raster is read as long as the files that it refers to would be.
TEST_F(HostileFiles, FindsACrashBehindAVirtualRaster)
{
    const std::string inner = faulty("crash while reading slowly");
    const std::string path = folder_.write(
        "outer.vrt",
        "<VRTDataset rasterXSize=\"20\" rasterYSize=\"20\"><VRTRasterBand dataType=\"Int16\" "
        "band=\"1\"><SimpleSource><SourceFilename>" +
            inner + "</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>");
    const ProgramOutput output = info(path);
    expectOneLine(output, path);
    EXPECT_THAT(output.err, HasSubstr("crashed on this file"));
}

TEST_F(HostileFiles, StopsADriverThatNeverEnds)
{
    environment_ = {"MARSVIEW_OPEN_SECONDS=1"};
    const std::string path = faulty("hang");
    const ProgramOutput output = info(path);
    expectOneLine(output, path);
    EXPECT_THAT(output.err,
                HasSubstr("the FAULTY driver of GDAL did not open this file within 1 s"));
}

// A child that waits for it again would take the limit again.
TEST_F(HostileFiles, RemembersADriverThatDidNotEndUntilTheLimitIsRaised)
{
    environment_ = {"MARSVIEW_OPEN_SECONDS=2"};
    const std::string path = faulty("hang");
    EXPECT_THAT(info(path).err, HasSubstr("within 2 s"));
    environment_ = {"MARSVIEW_OPEN_SECONDS=1"};
    EXPECT_THAT(info(path).err, HasSubstr("within 2 s")) << "the child's limit, which was higher";
    environment_ = {"MARSVIEW_OPEN_SECONDS=3"};
    EXPECT_THAT(info(path).err, HasSubstr("within 3 s"));
    folder_.write(fs::path(path).filename().string(), "a whole file in its place");
    EXPECT_THAT(info(path).err, Not(HasSubstr("within")));
}

TEST_F(HostileFiles, StopsADriverThatTakesAllMemory)
{
    environment_ = {"MARSVIEW_OPEN_MB=300"};
    const std::string path = faulty("memory");
    const ProgramOutput output = info(path);
    expectOneLine(output, path);
    EXPECT_THAT(output.err, HasSubstr("the FAULTY driver of GDAL needs more than 0.3 GB"));
}

TEST_F(HostileFiles, DiscardsOutputOfLibraries)
{
    const ProgramOutput opened = info(faulty("print"), {"--json"});
    EXPECT_EQ(opened.exit_status, 0) << opened.err;
    EXPECT_THAT(opened.err, Not(HasSubstr("library")));
    EXPECT_EQ(nlohmann::json::parse(opened.out)["maximum"], 399.0);
    const std::string path = faulty("refuse");
    const ProgramOutput refused = info(path);
    expectOneLine(refused, path);
    EXPECT_THAT(refused.err, HasSubstr("(The header is wrong. In two lines); fetch it again"));
}

// 2026-11: HDF5 crashed at exit after opening a file successfully.
TEST_F(HostileFiles, IgnoresALibraryThatCrashesOnExit)
{
    const ProgramOutput output = info(faulty("crash at exit"), {"--json"});
    EXPECT_EQ(output.exit_status, 0);
    EXPECT_EQ(nlohmann::json::parse(output.out)["maximum"], 399.0);
}

// 2026-11: HDF5 created 20 000 files next to a damaged one.
TEST_F(HostileFiles, LibrariesCannotCreateFiles)
{
    constexpr unsigned kVersion = 1; // LANDLOCK_CREATE_RULESET_VERSION
    if (syscall(SYS_landlock_create_ruleset, nullptr, 0, kVersion) < 1) {
        GTEST_SKIP() << "this kernel has no Landlock";
    }
    const std::string path = faulty("write");
    expectOneLine(info(path), path);
    EXPECT_FALSE(fs::exists(path + ".made"));
}

TEST_F(HostileFiles, CachesTheResultUntilTheFileChanges)
{
    const std::string path = faulty("crash");
    expectOneLine(info(path), path);
    environment_ = {"GDAL_DRIVER_PATH=/nonexistent"}; // the file has no driver now
    EXPECT_THAT(info(path).err, HasSubstr("the FAULTY driver of GDAL crashed"));
    faulty("crash"); // the same bytes, written again
    EXPECT_THAT(info(path).err, HasSubstr("is not a raster that GDAL can read"));
}

TEST_F(HostileFiles, RefusesATiffThatDeclaresMoreBlocksThanItHolds)
{
    for (const auto& [listed, place] :
         std::vector<std::pair<std::uint32_t, std::uint32_t>>{{1U << 24U, 200}, {1, 0}}) {
        const std::string path = folder_.write("many_blocks.tif", manyBlocks(listed, place));
        const ProgramOutput output = info(path);
        expectOneLine(output, path);
        EXPECT_THAT(output.err, AllOf(HasSubstr("16777216 blocks"), HasSubstr("cut short")));
    }
}

// 2026-11: GDAL 3.6 searches endlessly for a row beyond the last one.
TEST_F(HostileFiles, RefusesATruncatedTextGrid)
{
    const std::string whole = test::readFile(test::writeRaster(
        folder_, "whole.asc", "AAIGrid",
        test::recipeFor(32, std::vector<std::int16_t>(std::size_t{32} * 32, 1234))));
    EXPECT_EQ(info(folder_.file("whole.asc")).exit_status, 0);
    const std::string zero_byte = whole.substr(0, whole.size() / 2) + std::string(1, '\0') +
                                  whole.substr(whole.size() / 2 + 1);
    for (const std::string& text :
         {whole.substr(0, whole.size() / 2), whole.substr(0, whole.size() - 6), zero_byte}) {
        const std::string path = folder_.write("map.asc", text);
        const ProgramOutput output = info(path);
        expectOneLine(output, path);
        EXPECT_THAT(output.err, HasSubstr("its header promises 1024 samples"));
    }
}

// A POSIX archive of one file.
std::string tarOf(const std::string& name, const std::string& content)
{
    std::string header(512, '\0');
    const auto put = [&header](std::size_t at, const std::string& text) {
        header.replace(at, text.size(), text);
    };
    put(0, name);
    put(100, "0000644");
    put(124, fmt::format("{:011o}", content.size()));
    put(136, "00000000000");
    put(148, "        "); // counts as blanks in the checksum
    put(156, "0");
    put(257, "ustar");
    put(263, "00");
    unsigned sum = 0;
    for (const char c : header) {
        sum += static_cast<unsigned char>(c);
    }
    put(148, fmt::format("{:06o}", sum) + std::string(1, '\0'));
    std::string archive = header + content;
    archive.resize((archive.size() + 511) / 512 * 512 + 1024, '\0');
    return archive;
}

TEST_F(HostileFiles, RefusesATruncatedTextGridInAnArchiveAndBesideACompanion)
{
    const std::string whole = test::readFile(test::writeRaster(
        folder_, "whole.asc", "AAIGrid",
        test::recipeFor(32, std::vector<std::int16_t>(std::size_t{32} * 32, 1234))));
    const std::string half = whole.substr(0, whole.size() / 2);
    const std::string in_archive = folder_.write("map.tar", tarOf("map.asc", half));
    const std::string with_companion = folder_.write("map.asc", half);
    folder_.write("map.aux", "a companion");
    const ProgramOutput archive = info(in_archive);
    expectOneLine(archive, in_archive);
    EXPECT_THAT(archive.err, HasSubstr("its header promises 1024 samples"));
    const ProgramOutput companion = info(with_companion);
    expectOneLine(companion, with_companion);
    EXPECT_THAT(companion.err, HasSubstr("its header promises 1024 samples"));
}

// PROJ would print that it does not know the unit.
TEST_F(HostileFiles, PrintsNoLineForAnUnknownUnitOfAngle)
{
    test::RasterRecipe recipe =
        test::recipeFor(32, std::vector<std::int16_t>(std::size_t{32} * 32, 1234));
    recipe.srs = "+proj=longlat +R=3396190 +no_defs";
    std::string bytes = test::readFile(test::writeRaster(folder_, "map.tif", "GTiff", recipe));
    const auto key = [](std::uint64_t unit) { // GeogAngularUnits
        return bytesOf(2054, 2) + bytesOf(0, 2) + bytesOf(1, 2) + bytesOf(unit, 2);
    };
    const std::size_t at = bytes.find(key(9102));
    ASSERT_NE(at, std::string::npos);
    bytes.replace(at, 8, key(9176));
    const ProgramOutput output = info(folder_.write("map.tif", bytes));
    EXPECT_EQ(output.err.find("proj_uom"), std::string::npos) << output.err;
}

// A child for each of hundreds of rasters would take a minute.
TEST_F(HostileFiles, LooksAtAllRastersOfAnArchiveInOneChild)
{
    const fs::path maps = folder_.path() / "maps";
    fs::create_directories(maps);
    const std::string raster = test::readFile(test::writeRaster(
        folder_, "map.tif", "GTiff",
        test::recipeFor(32, std::vector<std::int16_t>(std::size_t{32} * 32, 1234))));
    for (int i = 0; i < 20; ++i) {
        folder_.write(fmt::format("maps/{}.tif", i), raster);
    }
    folder_.write("maps/cut.tif", raster.substr(0, 100));
    const std::string archive = folder_.file("maps.tar");
    test::runTool({"tar", "-cf", archive, "-C", folder_.path().string(), "maps"});
    const fs::path cache = folder_.path() / "cache";
    const ProgramOutput output =
        test::runCliWith({"MARSVIEW_CACHE_DIR=" + cache.string()}, {"info", archive});
    EXPECT_EQ(output.exit_status, 0) << output.err;
    EXPECT_THAT(output.err, HasSubstr("20 rasters were found in the archive"));
    const auto answers = fs::directory_iterator(cache / "opened");
    EXPECT_EQ(std::distance(begin(answers), end(answers)), 1) << "of the raster that is open";
}

TEST_F(HostileFiles, RefusesDecompressionBombs)
{
    std::vector<std::string> paths{
        folder_.write("loop.tif", tiffOf({{256, kLong, 1, 4},
                                          {257, kLong, 1, 4},
                                          {258, kShort, 1, 8},
                                          {259, kShort, 1, 1},
                                          {262, kShort, 1, 1},
                                          {273, kLong, 1, 8},
                                          {277, kShort, 1, 1},
                                          {278, kLong, 1, 4},
                                          {279, kLong, 1, 16}},
                                         8)),
        folder_.write("huge.asc",
                      "ncols 1000000000\nnrows 1000000000\nxllcorner 0\nyllcorner 0\n"
                      "cellsize 1\n1 2 3\n"),
        folder_.write("large.asc",
                      "ncols 10000\nnrows 10000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n"),
        folder_.write("empty.tif", ""),
        "/dev/zero",
    };
    const auto virtual_of = [&](const std::string& name, const std::string& source) {
        return folder_.write(
            name,
            "<VRTDataset rasterXSize=\"20\" rasterYSize=\"20\"><VRTRasterBand "
            "dataType=\"Byte\" band=\"1\"><SimpleSource><SourceFilename relativeToVRT=\"0\">" +
                source + "</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>");
    };
    paths.push_back(virtual_of("itself.vrt", folder_.file("itself.vrt")));
    paths.push_back(virtual_of("zero.vrt", "/dev/zero"));
    const std::string pipe = folder_.file("pipe");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    paths.push_back(pipe);
    environment_ = {"MARSVIEW_OPEN_SECONDS=3"};
    paths.push_back(virtual_of("pipe.vrt", pipe));
    for (const std::string& path : paths) {
        SCOPED_TRACE(path);
        expectOneLine(info(path), path);
    }
}

// Changes a few bytes of a file, as failed transfers and bad disks do.
std::string damaged(std::string bytes, int how, test::Random& random)
{
    switch (how) {
    case 0:
        bytes.resize(1 + random.below(bytes.size() - 1));
        break;
    case 1:
        for (int i = 0; i < 8; ++i) {
            char& byte = bytes[random.below(bytes.size())];
            byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U << random.below(8)));
        }
        break;
    case 2: {
        const std::size_t begin = random.below(std::min<std::size_t>(bytes.size(), 600));
        const std::size_t count = std::min<std::size_t>(bytes.size() - begin, 1 + random.below(32));
        bytes.replace(begin, count, std::string(count, '\0'));
        break;
    }
    default: {
        const std::size_t begin = random.below(std::min<std::size_t>(bytes.size(), 400));
        const std::size_t count = std::min<std::size_t>(bytes.size() - begin, 4);
        bytes.replace(begin, count, std::string(count, '\xff'));
        break;
    }
    }
    return bytes;
}

TEST_F(HostileFiles, DamagedFilesOpenOrFailInOneLine)
{
    const std::vector<std::pair<std::string, std::string>> formats{
        {"GTiff", "tif"},   {"netCDF", "nc"}, {"JP2OpenJPEG", "jp2"}, {"HFA", "img"},
        {"AAIGrid", "asc"}, {"PNG", "png"},   {"NITF", "ntf"},        {"GSBG", "grd"},
        {"ISIS3", "cub"},   {"VICAR", "vic"}, {"FITS", "fits"},       {"RST", "rst"},
        {"PCIDSK", "pix"},  {"BT", "bt"},     {"XYZ", "xyz"},
    };
    std::vector<std::int16_t> samples(std::size_t{32} * 32);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] = static_cast<std::int16_t>(i % 251);
    }
    test::Random random;
    environment_ = {"MARSVIEW_OPEN_SECONDS=5"};
    for (const auto& [format, ending] : formats) {
        const std::string whole = test::readFile(
            test::writeRaster(folder_, "whole." + ending, format, test::recipeFor(32, samples)));
        for (int how = 0; how < 4; ++how) {
            const std::string path = folder_.write("map" + std::to_string(how) + "." + ending,
                                                   damaged(whole, how, random));
            SCOPED_TRACE(path);
            const ProgramOutput output = info(path);
            if (output.exit_status != 0) {
                expectOneLine(output, path);
                EXPECT_THAT(output.err, AnyOf(HasSubstr("fetch it again"), HasSubstr("is empty")));
            }
        }
    }
}

// 2026-11: the SRTMHGT driver of GDAL crashes on an entry that cannot be unpacked.
TEST_F(HostileFiles, RefusesAnArchiveWhoseEntryCannotBeUnpacked)
{
    folder_.write("N51W001.hgt", std::string(std::size_t{2} * 1201 * 1201, '\1'));
    const std::string path = folder_.file("N51W001.hgt.zip");
    ASSERT_EQ(test::runProgram({"python3", "-c",
                                "import sys, zipfile\n"
                                "z = zipfile.ZipFile(sys.argv[1], 'w', zipfile.ZIP_DEFLATED)\n"
                                "z.write(sys.argv[2], 'N51W001.hgt')",
                                path, folder_.file("N51W001.hgt")})
                  .exit_status,
              0);
    ASSERT_EQ(info(path).exit_status, 0);
    std::string bytes = test::readFile(path);
    for (const std::size_t at : {0U, 2U, 8U, 18U, 26U}) { // of the entry's own header
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
        folder_.write("N51W001.hgt.zip", damaged);
        const ProgramOutput output = info(path);
        EXPECT_LE(output.exit_status, 1) << at;
        if (output.exit_status != 0) {
            expectOneLine(output, path);
        }
    }
}

// 2026-11: a driver that looks for JSON in any text has its own words for a list of numbers.
TEST_F(HostileFiles, RefusesAListOfNumbersAsOtherTexts)
{
    std::string text;
    for (int i = 0; i < 3; ++i) {
        text += fmt::format(
            "{}6.530042355041 0 176.125875162171 -48.164270779097768864 "
            "5.762344694676510456 175.334308316285410561 9398502.0434687 "
            "84.663858149358862201 6333544.7732452481809 -559418252332.321555\n",
            i + 1);
    }
    const std::string path = folder_.write("numbers.dat", text);
    const ProgramOutput output = info(path);
    expectOneLine(output, path);
    EXPECT_THAT(output.err, HasSubstr("is not a raster that GDAL can read"));
}

TEST_F(HostileFiles, StatisticsCanBeSkipped)
{
    std::vector<std::int16_t> samples(std::size_t{32} * 32, 7);
    const std::string path =
        test::writeRaster(folder_, "map.tif", "GTiff", test::recipeFor(32, samples));
    const ProgramOutput output = info(path, {"--no-statistics", "--json"});
    ASSERT_EQ(output.exit_status, 0) << output.err;
    const auto json = nlohmann::json::parse(output.out);
    EXPECT_EQ(json["columns"], 32);
    for (const char* field : {"minimum", "maximum", "raw_minimum", "raw_maximum", "void_count"}) {
        EXPECT_TRUE(json[field].is_null()) << field;
    }
    EXPECT_THAT(info(path, {"--no-statistics"}).out, HasSubstr("minimum         unknown"));
}

// 100 million samples in one tile: GDAL would read it into memory as a whole.
TEST_F(HostileFiles, SkipsStatisticsOfHugeBlocks)
{
    const std::string path = test::writeRaster(
        folder_, "map.tif", "GTiff", test::recipeFor(2, std::vector<std::int16_t>{1, 2, 3, 4}),
        {"-outsize", "10000", "10000", "-co", "COMPRESS=ZSTD", "-co", "TILED=YES", "-co",
         "BLOCKXSIZE=10000", "-co", "BLOCKYSIZE=10000"});
    const ProgramOutput output = info(path, {"--json"});
    ASSERT_EQ(output.exit_status, 0) << output.err;
    EXPECT_TRUE(nlohmann::json::parse(output.out)["minimum"].is_null());
    EXPECT_THAT(output.err, HasSubstr("minimum, maximum and voids are not computed: is stored in "
                                      "blocks of 10000 × 10000 samples"));
}

} // namespace
} // namespace marsview
