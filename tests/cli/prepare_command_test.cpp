#include "tests/cli/run_cli.h"
#include "tests/support/gdal_tools.h"
#include "tests/support/make_raster.h"
#include "tests/support/random.h"
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <poll.h>

namespace marsview::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using testing::HasSubstr;

// A tall map: a checkpoint every 2048 rows.
std::string tallMap(const TempFolder& folder)
{
    Random random;
    std::vector<std::int16_t> samples(std::size_t{700} * 30'000);
    double height = 0.0;
    for (std::int16_t& sample : samples) {
        height += random.uniform(-3.0, 3.0) - 0.001 * height;
        sample = static_cast<std::int16_t>(height);
    }
    return writeVrt(folder, "tall", recipeFor<std::int16_t>(700, samples));
}

nlohmann::json checksumsOf(const std::string& path)
{
    nlohmann::json info = nlohmann::json::parse(runTool({"gdalinfo", "-json", "-checksum", path}));
    info.erase("description");
    info.erase("files");
    return info;
}

} // namespace

TEST(PrepareCommand, ReportsItsResultsAndSpeed)
{
    const TempFolder folder;
    const std::string source = tallMap(folder);
    const ProgramOutput output =
        runCli({"prepare", source, "-o", folder.file("map.tif"), "--json"});
    ASSERT_EQ(output.exit_status, 0) << output.err;
    EXPECT_EQ(output.err, "");
    const nlohmann::json json = nlohmann::json::parse(output.out);
    EXPECT_EQ(json["file"], folder.file("map.tif"));
    EXPECT_EQ(json["samples"], 700 * 30'000);
    EXPECT_EQ(json["samples_read"], 700 * 30'000);
    EXPECT_EQ(json["bytes"], fs::file_size(folder.file("map.tif")));
    EXPECT_GT(json["samples_per_second"], 0.0);
    EXPECT_GT(json["peak_memory_bytes"], 0);
    const nlohmann::json source_info = checksumsOf(source);
    const nlohmann::json info = checksumsOf(folder.file("map.tif"));
    EXPECT_EQ(firstBand(info)["checksum"], firstBand(source_info)["checksum"]);
    EXPECT_EQ(firstBand(info)["overviews"].size(), 7U);
    // `info` reads these values from the level file; they must equal the ones computed from the
    // source.
    const auto described = [](const std::string& path) {
        const ProgramOutput output_of_info = runCli({"info", path, "--json"});
        EXPECT_EQ(output_of_info.exit_status, 0) << output_of_info.err;
        nlohmann::json fields = nlohmann::json::parse(output_of_info.out);
        for (const char* field : {"file", "driver"}) {
            fields.erase(field);
        }
        return fields;
    };
    EXPECT_EQ(described(folder.file("map.tif")), described(source));
    const ProgramOutput words = runCli({"prepare", source, "-o", folder.file("other.tif")});
    EXPECT_EQ(words.exit_status, 0);
    EXPECT_THAT(words.out, HasSubstr("throughput"));
}

TEST(PrepareCommand, ProducesTheSameFileHoweverOftenItIsKilled)
{
    // Not after every row of tiles: on a disk that takes 20 ms to sync a file, that would take
    // minutes.
    constexpr const char* kOften = "0.05";
    const TempFolder folder;
    const std::string source = tallMap(folder);
    const std::string whole = folder.file("whole.tif");
    const std::string path = folder.file("map.tif");
    const auto start = Clock::now();
    ASSERT_EQ(runCli({"prepare", source, "-o", whole, "--checkpoint", kOften}).exit_status, 0);
    const auto duration_ms =
        std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start).count();
    const nlohmann::json expected = checksumsOf(whole);

    Random random;
    constexpr int kKills = 16;
    int kills = 0;
    int finished = 0;
    while (kills < kKills) {
        const std::string messages = folder.file("messages");
        RunningProgram program(
            {MARSVIEW_CLI, "prepare", source, "-o", path, "--checkpoint", kOften}, messages);
        const auto moment_ms =
            static_cast<int>(random.uniform(0.0, 0.7 * static_cast<double>(duration_ms)));
        poll(nullptr, 0, moment_ms); // a random moment, not a condition to wait for
        program.signal(SIGKILL);
        const int status = program.wait();
        if (status == -1) {
            ++kills;
            continue;
        }
        // the lock is free, and no leftover file disturbs
        ASSERT_EQ(status, 0) << readFile(messages);
        ++finished;
        ASSERT_EQ(checksumsOf(path), expected);
        fs::remove(path);
    }
    // Once more, from a kill that left unfinished files.
    const std::string checkpoint = path + ".part.checkpoint";
    fs::remove(path);
    for (int i = 0; i < 100 && !fs::exists(checkpoint); ++i) {
        RunningProgram program(
            {MARSVIEW_CLI, "prepare", source, "-o", path, "--checkpoint", kOften},
            folder.file("messages"));
        poll(nullptr, 0,
             static_cast<int>(random.uniform(0.1, 0.5) * static_cast<double>(duration_ms)));
        program.signal(SIGKILL);
        program.wait();
        if (fs::exists(path)) { // the copy was complete
            fs::remove(path);
        }
    }
    ASSERT_TRUE(fs::exists(checkpoint));
    const ProgramOutput last = runCli({"prepare", source, "-o", path, "--checkpoint", kOften});
    ASSERT_EQ(last.exit_status, 0) << last.err;
    EXPECT_THAT(last.err, HasSubstr("resumed after row"));
    EXPECT_EQ(checksumsOf(path), expected);
    // Few bytes remain of data that was written after the last checkpoint.
    EXPECT_LT(static_cast<double>(fs::file_size(path)),
              1.02 * static_cast<double>(fs::file_size(whole)));
    for (const char* ending : {".part", ".part.checkpoint", ".part.checkpoint.new", ".lock"}) {
        EXPECT_FALSE(fs::exists(path + ending)) << ending;
    }
    std::printf("%d kills, %d finished before theirs\n", kills, finished);
}

TEST(PrepareCommand, StopsOnCtrlCAndResumesLater)
{
    const TempFolder folder;
    const std::string source = tallMap(folder);
    const std::string path = folder.file("map.tif");
    const std::string messages = folder.file("messages");
    RunningProgram program({MARSVIEW_CLI, "prepare", source, "-o", path, "--checkpoint", "0"},
                           messages);
    while (!fs::exists(path + ".part.checkpoint") && !fs::exists(path)) {
        poll(nullptr, 0, 1);
    }
    program.signal(SIGINT);
    EXPECT_EQ(program.wait(), 1) << readFile(messages);
    EXPECT_EQ(readFile(messages),
              fmt::format("marsview-cli: {}: preparing was canceled; prepare it "
                          "again to resume\n",
                          path));
    const ProgramOutput second = runCli({"prepare", source, "-o", path});
    EXPECT_EQ(second.exit_status, 0);
    EXPECT_THAT(second.err, HasSubstr("resumed after row"));
    EXPECT_EQ(firstBand(checksumsOf(path))["checksum"], firstBand(checksumsOf(source))["checksum"]);
}

TEST(PrepareCommand, ReportsAFullDiskAndResumesWhenThereIsSpace)
{
    const TempFolder folder;
    const std::string source = tallMap(folder);
    const std::string path = folder.file("map.tif");
    // A limit on the file size, in blocks of 512 bytes, simulates a full disk.
    for (const auto& [blocks, is_resumed] : {std::pair{200, false}, std::pair{20'000, true}}) {
        const ProgramOutput output = runProgram(
            {"sh", "-c",
             fmt::format(
                 "trap '' XFSZ; ulimit -f {}; exec '{}' prepare '{}' -o '{}' --checkpoint 0",
                 blocks, MARSVIEW_CLI, source, path)});
        EXPECT_EQ(output.exit_status, 1);
        EXPECT_THAT(output.err, testing::StartsWith("marsview-cli: " + path));
        EXPECT_THAT(output.err, HasSubstr("largest file size that is allowed"));
        EXPECT_EQ(std::count(output.err.begin(), output.err.end(), '\n'), 1) << output.err;
        EXPECT_FALSE(fs::exists(path));
        EXPECT_EQ(fs::exists(path + ".part"), is_resumed);
        const ProgramOutput later = runCli({"prepare", source, "-o", path});
        EXPECT_EQ(later.exit_status, 0) << later.err;
        EXPECT_EQ(later.err.find("resumed after row") != std::string::npos, is_resumed)
            << later.err;
        EXPECT_EQ(firstBand(checksumsOf(path))["checksum"],
                  firstBand(checksumsOf(source))["checksum"]);
        fs::remove(path);
    }
}

TEST(PrepareCommand, ChecksForDiskSpaceInAdvance)
{
    const TempFolder folder;
    const std::string source = tallMap(folder); // 42 MB raw
    fs::create_directory(folder.path() / "small");
    const std::string script = fmt::format(
        "mount -t tmpfs -o size=20m tmpfs '{0}' || exit 99; exec '{1}' prepare '{2}' -o "
        "'{0}/map.tif'",
        folder.file("small"), MARSVIEW_CLI, source);
    const ProgramOutput output = runProgram({"unshare", "-Urm", "sh", "-c", script});
    if (output.exit_status == 99 || output.exit_status == 127 ||
        output.err.find("unshare") != std::string::npos) {
        GTEST_SKIP() << "cannot create a small disk on this machine: " << output.err;
    }
    EXPECT_EQ(output.exit_status, 1);
    EXPECT_THAT(output.err, HasSubstr("needs up to 57 MB, but"));
    EXPECT_THAT(output.err, HasSubstr(" MB free"));
}

TEST(PrepareCommand, UsesATiledMapWithOverviewsInPlace)
{
    const TempFolder folder;
    const std::string source = tallMap(folder);
    const std::string path = folder.file("map.tif");
    ASSERT_EQ(runCli({"prepare", source, "-o", path}).exit_status, 0);
    const std::string before = readFile(path);
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"prepare", path, "--json"},
          {"prepare", path, "-o", path, "--json"}}) {
        const ProgramOutput output = runCli(arguments);
        ASSERT_EQ(output.exit_status, 0) << output.err;
        const nlohmann::json json = nlohmann::json::parse(output.out);
        EXPECT_EQ(json["is_source_used"], true);
        EXPECT_EQ(json["file"], path);
    }
    EXPECT_EQ(readFile(path), before);
}

TEST(PrepareCommand, OverwritesNothingButPreparedMaps)
{
    const TempFolder folder;
    const std::string source = tallMap(folder);
    const std::string own = folder.write("notes.tif", "weeks of work\n");
    const std::string raster = writeRaster(folder, "own.tif", "GTiff",
                                           recipeFor<std::int16_t>(3, {1, 2, 3, 4, 5, 6, 7, 8, 9}));
    for (const std::string& there : {own, raster}) {
        const std::string before = readFile(there);
        const ProgramOutput output = runCli({"prepare", source, "-o", there});
        EXPECT_EQ(output.exit_status, 1);
        EXPECT_THAT(output.err, HasSubstr(there + ": already exists and is not a prepared map"));
        EXPECT_TRUE(readFile(there) == before);
    }
    // An empty file, as mktemp creates it, and a file that prepare itself has written.
    const std::string empty = folder.write("map.tif", "");
    for (int i = 0; i < 2; ++i) {
        const ProgramOutput output = runCli({"prepare", source, "-o", empty});
        EXPECT_EQ(output.exit_status, 0) << output.err;
    }
}

TEST(PrepareCommand, KeepsMapsInTheFolderOfPreparedMaps)
{
    const TempFolder folder;
    const TempFolder maps;
    const std::string source = tallMap(folder);
    const ProgramOutput output =
        runCliWith({"MARSVIEW_CACHE_DIR=" + maps.path().string()}, {"prepare", source, "--json"});
    ASSERT_EQ(output.exit_status, 0) << output.err;
    const std::string file = nlohmann::json::parse(output.out)["file"].get<std::string>();
    EXPECT_EQ(fs::path(file).parent_path(), maps.path());
    EXPECT_TRUE(fs::exists(file));
    EXPECT_EQ(firstBand(checksumsOf(file))["checksum"], firstBand(checksumsOf(source))["checksum"]);
}

TEST(PrepareCommand, KeepsLevelFilesThatFitNowhereElseInTheFolderOfPreparedMaps)
{
    const TempFolder folder;
    const TempFolder maps;
    const std::string path = writeRaster(folder, "tiled.tif", "GTiff",
                                         recipeFor<std::int16_t>(3, {1, 2, 3, 4, 5, 6, 7, 8, 9}));
    runTool({"gzip", path}); // no file can be written next to the raster in it
    const ProgramOutput output = runCliWith({"MARSVIEW_CACHE_DIR=" + maps.path().string()},
                                            {"prepare", path + ".gz", "--json"});
    ASSERT_EQ(output.exit_status, 0) << output.err;
    const nlohmann::json json = nlohmann::json::parse(output.out);
    EXPECT_EQ(fs::path(json["level_file"].get<std::string>()).parent_path(), maps.path());
    EXPECT_EQ(json["is_source_used"], true);
}

TEST(PrepareCommand, RemovesTheLeastRecentlyUsedMapFromAFullDisk)
{
    const TempFolder folder;
    const std::string source = tallMap(folder); // 42 MB raw
    fs::create_directory(folder.path() / "small");
    const std::string script = fmt::format(
        "mount -t tmpfs -o size=72m tmpfs '{0}' || exit 99; export MARSVIEW_CACHE_DIR='{0}/maps'; "
        "'{1}' prepare '{2}' || exit 1; ls '{0}/maps'; touch -d 2020-01-01 '{2}'; "
        "'{1}' prepare '{2}' || exit 2; ls '{0}/maps'",
        folder.file("small"), MARSVIEW_CLI, source);
    const ProgramOutput output = runProgram({"unshare", "-Urm", "sh", "-c", script});
    if (output.exit_status == 99 || output.exit_status == 127 ||
        output.err.find("unshare") != std::string::npos) {
        GTEST_SKIP() << "cannot create a small disk on this machine: " << output.err;
    }
    EXPECT_EQ(output.exit_status, 0) << output.err;
}

TEST(PrepareCommand, PreparedMapsOpenFromAReadOnlyFolder)
{
    const TempFolder folder;
    const TempFolder maps;
    const std::string source = tallMap(folder);
    folder.write("goals.csv", "x,y,z\n1100,1900,-100\n");
    const std::string script = fmt::format(
        "export MARSVIEW_CACHE_DIR='{0}' MARSVIEW_HELD_MB=0; '{1}' prepare '{2}' || exit 3; "
        "mount --bind '{0}' '{0}' && mount -o remount,bind,ro '{0}' || exit 99; "
        "exec '{1}' trace '{2}' --goals '{3}'",
        maps.path().string(), MARSVIEW_CLI, source, folder.file("goals.csv"));
    const ProgramOutput output = runProgram({"unshare", "-Urm", "sh", "-c", script});
    if (output.exit_status == 99 || output.exit_status == 127 ||
        output.err.find("unshare") != std::string::npos) {
        GTEST_SKIP() << "cannot make a folder read-only on this machine: " << output.err;
    }
    EXPECT_EQ(output.exit_status, 0) << output.err;
}

// By GDAL's own script, with a mask and without.
TEST(PrepareCommand, WritesValidCloudOptimizedGeoTiffs)
{
    const TempFolder folder;
    const auto validated = [](const std::string& path) {
        return runProgram({"/usr/bin/python3", "-m",
                           "osgeo_utils.samples.validate_cloud_optimized_geotiff", path});
    };
    std::vector<std::int16_t> samples(std::size_t{1300} * 1500);
    std::vector<std::uint8_t> mask(samples.size(), 255);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] = static_cast<std::int16_t>(i * 7919 % 251);
        mask[i] = i % 1300 < 100 ? 0 : 255;
    }
    RasterRecipe masked = recipeFor(1300, samples);
    writeVrt(folder, "mask", recipeFor(1300, mask));
    masked.extra_xml =
        "<MaskBand><VRTRasterBand dataType=\"Byte\"><SimpleSource>"
        "<SourceFilename relativeToVRT=\"1\">mask.vrt</SourceFilename>"
        "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></MaskBand>";
    for (const std::string& source : {writeVrt(folder, "plain", recipeFor(1300, samples)),
                                      writeVrt(folder, "masked", masked)}) {
        const std::string out = folder.file("map.tif");
        const ProgramOutput usual = runCli({"prepare", source, "-o", out});
        ASSERT_EQ(usual.exit_status, 0) << usual.err;
        const ProgramOutput before = validated(out);
        if (before.err.find("No module named") != std::string::npos) {
            GTEST_SKIP() << "GDAL's Python modules are not installed";
        }
        EXPECT_THAT(before.out, HasSubstr("is NOT a valid cloud optimized GeoTIFF"));
        const nlohmann::json checksums = checksumsOf(out);
        // An existing file is put in order; a new one is written so.
        for (int i = 0; i < 2; ++i) {
            const ProgramOutput ordered = runCli({"prepare", source, "-o", out, "--cog"});
            ASSERT_EQ(ordered.exit_status, 0) << ordered.err;
            EXPECT_THAT(validated(out).out, HasSubstr("is a valid cloud optimized GeoTIFF"));
            EXPECT_EQ(checksumsOf(out), checksums);
            fs::remove(out);
            fs::remove(out + ".marsview");
        }
    }
}

TEST(PrepareCommand, RefusesPartsThatMakeNoSense)
{
    const TempFolder folder;
    const std::string out = folder.file("map.tif");
    const std::string dem = (sourceRoot() / "resources/samples/mars_mola_4ppd.tif").string();
    const auto refused = [&](const std::vector<std::string>& options, const std::string& why) {
        std::vector<std::string> arguments{"prepare", dem};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const ProgramOutput output = runCli(arguments);
        EXPECT_EQ(output.exit_status, 2);
        EXPECT_THAT(output.err, HasSubstr(why));
    };
    refused({"-o", out, "--parts", "4"}, "needs either --part or --join");
    refused({"-o", out, "--parts", "4", "--part", "1", "--join"}, "needs either --part or --join");
    refused({"-o", out, "--parts", "4", "--part", "5"}, "5 is greater than --parts 4");
    refused({"-o", out, "--parts", "4", "--part", "0"}, "--part");
    refused({"-o", out, "--join"}, "--parts");
    refused({"--parts", "4", "--part", "1"}, "--output");
    refused({"-o", "s3://maps/map.tif", "--parts", "4", "--join"}, "--parts-folder");
    EXPECT_EQ(runCli({"prepare", dem, "-o", out, "--parts", "3", "--join"}).exit_status, 1);
}

TEST(PrepareCommand, FailsInOneLine)
{
    const TempFolder folder;
    const std::string path = folder.file("nothing.tif");
    const ProgramOutput output = runCli({"prepare", path, "-o", folder.file("map.tif")});
    EXPECT_EQ(output.exit_status, 1);
    EXPECT_EQ(output.err, fmt::format("marsview-cli: {}: does not exist\n", path));
    EXPECT_EQ(runCli({"prepare"}).exit_status, 2);
}

} // namespace marsview::test
