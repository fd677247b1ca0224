#include "haptics/device/last_trouble.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <iterator>
#include <string>

namespace marsview::test {
namespace {

namespace fs = std::filesystem;

std::size_t filesIn(const fs::path& folder)
{
    const fs::directory_iterator files(folder);
    return static_cast<std::size_t>(std::distance(fs::begin(files), fs::end(files)));
}

} // namespace

TEST(LastTrouble, IsKeptForItsDeviceUntilCleared)
{
    const TempFolder folder;
    const fs::path below = folder.path() / "is" / "made";
    const LastTrouble left(below, "plugin:x.so#left");
    const LastTrouble right(below, "plugin:x.so#right");
    EXPECT_EQ(left.get(), "");
    left.set("the cover is open");
    left.set("the coil is cold");
    EXPECT_EQ(LastTrouble(below, "plugin:x.so#left").get(), "the coil is cold");
    EXPECT_EQ(right.get(), "");
    left.set("");
    EXPECT_EQ(left.get(), "");
    EXPECT_EQ(filesIn(below), 0U);
    right.set("");
}

TEST(LastTrouble, KeepsFewAndSmallFiles)
{
    const TempFolder folder;
    for (std::size_t i = 0; i < 3 * LastTrouble::kFilesMax; ++i) {
        LastTrouble(folder.path(), "device " + std::to_string(i)).set(std::string(100'000, 'x'));
        // The first is the oldest, whatever the resolution of file times.
        for (const auto& entry : fs::directory_iterator(folder.path())) {
            fs::last_write_time(entry, entry.last_write_time() - std::chrono::seconds(1));
        }
    }
    EXPECT_EQ(filesIn(folder.path()), LastTrouble::kFilesMax);
    for (const auto& entry : fs::directory_iterator(folder.path())) {
        EXPECT_EQ(entry.file_size(), LastTrouble::kBytesMax);
    }
    const auto of = [&](std::size_t i) {
        return LastTrouble(folder.path(), "device " + std::to_string(i)).get();
    };
    EXPECT_EQ(of(0), "");
    EXPECT_EQ(of(2 * LastTrouble::kFilesMax - 1), "");
    EXPECT_EQ(of(2 * LastTrouble::kFilesMax), std::string(LastTrouble::kBytesMax, 'x'));
    EXPECT_EQ(of(3 * LastTrouble::kFilesMax - 1), std::string(LastTrouble::kBytesMax, 'x'));
}

TEST(LastTrouble, IsDroppedIfNothingCanBeWritten)
{
    const TempFolder folder;
    const std::string file = folder.write("file", "");
    const LastTrouble last(fs::path(file) / "below", "a device");
    last.set("the cover is open");
    EXPECT_EQ(last.get(), "");
}

} // namespace marsview::test
