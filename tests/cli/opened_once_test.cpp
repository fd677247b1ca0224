// Every command opens each file of its map once, and passes the open file on. Files that are not
// plain rasters are opened by a child process first (core/files/open_guard.h), which counts here,
// too.
#include "tests/cli/run_cli.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <sys/inotify.h>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace marsview::test {
namespace {

// Counts how often any process opens a file, by the kernel's events (inotify(7)).
class OpenCounter {
public:
    explicit OpenCounter(const std::string& path)
        : queue_(inotify_init1(IN_NONBLOCK))
    {
        // The kernel merges equal events in a row: reading and closing keep two opens apart.
        if (queue_ < 0 ||
            inotify_add_watch(queue_, path.c_str(), IN_OPEN | IN_ACCESS | IN_CLOSE) < 0) {
            throw std::system_error(errno, std::generic_category(), path);
        }
    }
    ~OpenCounter() { close(queue_); }
    OpenCounter(const OpenCounter&) = delete;
    OpenCounter& operator=(const OpenCounter&) = delete;

    // Since the last call.
    std::size_t take() const
    {
        std::size_t count = 0;
        alignas(inotify_event) std::array<char, 65536> events{};
        for (;;) {
            const ssize_t bytes = read(queue_, events.data(), events.size());
            if (bytes <= 0) {
                return count;
            }
            for (ssize_t at = 0; at < bytes;) {
                const auto* event = reinterpret_cast<const inotify_event*>(events.data() + at);
                count += (event->mask & IN_OPEN) != 0 ? 1U : 0U;
                at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
            }
        }
    }

private:
    int queue_;
};

// Files of different kinds; some are opened through another of them.
class OpenedOnce : public testing::Test {
protected:
    // Fails if the command opens a file more than `opens_max` times.
    static void expectOpens(std::size_t opens_max,
                            const std::vector<std::string>& files,
                            const std::vector<std::string>& command)
    {
        std::vector<std::unique_ptr<OpenCounter>> counters;
        for (const std::string& file : files) {
            counters.push_back(std::make_unique<OpenCounter>(file));
        }
        const ProgramOutput output = runCli(command);
        EXPECT_EQ(output.exit_status, 0) << testing::PrintToString(command) << output.err;
        for (std::size_t i = 0; i < files.size(); ++i) {
            const std::size_t opens = counters[i]->take();
            EXPECT_GE(opens, 1U) << files[i] << testing::PrintToString(command);
            EXPECT_LE(opens, opens_max) << files[i] << testing::PrintToString(command);
        }
    }

    TempFolder folder_;
    std::string goals_ = folder_.write("goals.csv", "x,y,z\n0,0,0\n1000,0,0\n");
};

TEST_F(OpenedOnce, EveryCommandOpensItsMapOnce)
{
    const std::string map = folder_.file("map.tif");
    std::filesystem::copy_file(bundledMountain(), map);
    // Compared with the files of the map before it is replaced.
    const std::string picture = folder_.write("picture.png", "");
    const std::string prepared = folder_.file("prepared.tif");
    const std::vector<std::vector<std::string>> commands{
        {"info", map},
        {"sample", map, "--pixel", "3", "3"},
        {"trace", map, "--goals", goals_},
        {"loop", map, "--device", "null:", "--seconds", "0.1"},
        {"render", map, "-o", picture, "--size", "64x48"},
        {"thumbnail", map, "-o", picture},
        {"bench", "view", map, "--size", "64x48", "--frames", "2", "--poses", "1"},
        {"prepare", map, "-o", prepared},
        {"prepare", map, "-o", prepared}}; // which is there now
    for (const std::vector<std::string>& command : commands) {
        expectOpens(1, {map}, command);
    }
}

TEST_F(OpenedOnce, ThreadsThatReadTilesShareTheFilesOfAPreparedMap)
{
    const std::string map = folder_.file("prepared.tif");
    ASSERT_EQ(runCli({"prepare", bundledMountain(), "-o", map}).exit_status, 0);
    const std::vector<std::string> files{map, map + ".marsview"};
    expectOpens(1, files, {"loop", map, "--device", "null:", "--seconds", "0.1"});
    expectOpens(1, files, {"render", map, "-o", folder_.file("picture.png"), "--size", "64x48"});
}

TEST_F(OpenedOnce, LabelsAndHeadersAndTheirDataAreOpenedOnce)
{
    folder_.write("dem.lbl",
                  "PDS_VERSION_ID = PDS3\r\nRECORD_TYPE = FIXED_LENGTH\r\n"
                  "RECORD_BYTES = 16\r\nFILE_RECORDS = 8\r\n^IMAGE = \"dem.img\"\r\n"
                  "OBJECT = IMAGE\r\n  LINES = 8\r\n  LINE_SAMPLES = 8\r\n"
                  "  SAMPLE_TYPE = MSB_INTEGER\r\n  SAMPLE_BITS = 16\r\n"
                  "END_OBJECT = IMAGE\r\nEND\r\n");
    const std::string image = folder_.write("dem.img", std::string(128, '\1'));
    const std::string tile = folder_.write("N44W072.hgt", std::string(1201 * 1201 * 2, '\0'));
    runTool({"gdal_translate", "-q", "-of", "EHdr", bundledMountain(), folder_.file("grid.flt")});
    for (const auto& files : std::vector<std::vector<std::string>>{
             {folder_.file("dem.lbl"), image},
             {tile},
             {folder_.file("grid.flt"), folder_.file("grid.hdr")}}) {
        expectOpens(1, files, {"prepare", files.front(), "-o", folder_.file("prepared.tif")});
    }
}

TEST_F(OpenedOnce, ArchivesAndVirtualRastersAreOpenedOnceByEachProcess)
{
    const std::string map = folder_.file("map.tif");
    std::filesystem::copy_file(bundledMountain(), map);
    const std::string archive = folder_.file("map.zip");
    const std::string zipped = folder_.file("map.tif.gz");
    const std::string whole = folder_.file("map.vrt");
    runTool({"python3", "-m", "zipfile", "-c", archive, map});
    runTool({"gzip", "-k", map});
    runTool({"gdalbuildvrt", "-q", whole, map});
    const auto sample = [](const std::string& path) {
        return std::vector<std::string>{"sample", path, "--pixel", "3", "3"};
    };
    // One child looks for rasters in the archive, another one tries to open the one that is found.
    expectOpens(3, {archive}, sample(archive));
    expectOpens(2, {zipped}, sample(zipped));
    expectOpens(2, {whole, map}, sample(whole));
    expectOpens(1, {zipped}, sample(zipped)); // the child's answer is stored
}

} // namespace
} // namespace marsview::test
