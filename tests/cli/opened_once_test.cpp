// Every command opens its raster once, and passes the open file on.
#include "tests/cli/run_cli.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <fstream>
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

// Two opens are expected: our own check of the header, and GDAL's.
TEST(OpenedOnce, EveryCommandOpensItsMapOnce)
{
    const TempFolder folder;
    const std::string map = folder.file("map.tif");
    std::filesystem::copy_file(bundledMars(), map);
    const std::string goals = folder.write("goals.csv", "x,y,z\n0,0,0\n1000,0,0\n");
    const std::vector<std::vector<std::string>> commands{
        {"info", map, "--no-statistics"},
        {"info", map},
        {"sample", map, "--lonlat", "10", "10"},
        {"trace", map, "--goals", goals},
        {"loop", map, "--device", "null:", "--seconds", "0.1"},
        {"render", map, "-o", folder.file("picture.png")}};
    const OpenCounter opens(map);
    for (const std::vector<std::string>& command : commands) {
        const ProgramOutput output = runCli(command);
        EXPECT_EQ(output.exit_status, 0) << command.front() << ": " << output.err;
        EXPECT_LE(opens.take(), 2U) << command.front();
    }
}

} // namespace
} // namespace marsview::test
