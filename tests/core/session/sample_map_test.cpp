#include "core/session/sample_map.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

namespace marsview::test {
namespace {

constexpr const char* kFile = "mars_mola_4ppd.tif";

// A folder in the temporary one, with the map in it if requested.
std::filesystem::path made(const TempFolder& folder, const char* name)
{
    const std::filesystem::path path = folder.path() / name;
    std::filesystem::create_directories(path);
    return path;
}

} // namespace

TEST(SampleMap, IsFoundNextToTheInstalledProgram)
{
    const TempFolder folder;
    const auto bin = made(folder, "usr/bin");
    made(folder, "usr/share/marsview/samples");
    const std::string map =
        folder.write(std::string("usr/share/marsview/samples/") + kFile, "a map");
    EXPECT_EQ(sampleMapFor(bin), std::filesystem::canonical(map));
}

TEST(SampleMap, IsFoundAboveTheBuildTree)
{
    const TempFolder folder;
    const auto bin = made(folder, "source/build/release/bin");
    made(folder, "source/resources/samples");
    const std::string map = folder.write(std::string("source/resources/samples/") + kFile, "a map");
    EXPECT_EQ(sampleMapFor(bin), std::filesystem::canonical(map));
}

TEST(SampleMap, MayBeMissing)
{
    const TempFolder folder;
    EXPECT_EQ(sampleMapFor(made(folder, "bin")), std::filesystem::path());
    EXPECT_EQ(sampleMapFor(folder.path() / "nowhere"), std::filesystem::path());
}

} // namespace marsview::test
