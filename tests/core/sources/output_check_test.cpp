#include "core/sources/output_check.h"
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(OutputCheck, RefusesInputFilesUnderAnyName)
{
    const TempFolder folder;
    const std::string map = folder.file("map.tif");
    fs::copy_file(bundledMars(), map);
    fs::create_symlink(map, folder.file("link.tif"));
    fs::create_hard_link(map, folder.file("hard.tif"));
    const std::string goals = folder.write("goals.csv", "x,y,z\n");
    const auto check = [&](const std::vector<std::string>& written) {
        const auto status = checkOutputs({.maps = {map}, .read = {goals}, .written = written});
        return status ? std::string() : status.error().message;
    };
    EXPECT_EQ(check({"", folder.file("new.csv"), folder.file("other.csv")}), "");
    EXPECT_EQ(check({folder.write("old.csv", "")}), "");
    EXPECT_EQ(check({"/dev/null", "/dev/null"}), "");
    for (const char* name : {"map.tif", "link.tif", "hard.tif", "./map.tif"}) {
        EXPECT_THAT(check({folder.file(name)}), HasSubstr("is an input raster or a part of one"))
            << name;
    }
    EXPECT_THAT(check({goals}),
                HasSubstr("goals.csv: is an input file; choose another output file"));
    EXPECT_THAT(check({folder.file("new.csv"), folder.file("./new.csv")}),
                HasSubstr("is given for two outputs; choose two files"));
}

TEST(OutputCheck, RefusesAFileInAFolderThatIsNotThere)
{
    const TempFolder folder;
    const auto status = checkOutputs(
        {.maps = {bundledMars()}, .read = {}, .written = {folder.file("missing/picture.png")}});
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().message, folder.file("missing/picture.png") + ": the folder " +
                                          folder.file("missing") +
                                          " does not exist; create it first");
}

TEST(OutputCheck, RefusesThePartsOfAMap)
{
    const TempFolder folder;
    const std::string part = folder.file("part.tif");
    fs::copy_file(bundledMars(), part);
    const std::string whole = folder.file("whole.vrt");
    runTool({"gdalbuildvrt", "-q", whole, part});
    const auto status = checkOutputs({.maps = {whole}, .read = {}, .written = {part}});
    ASSERT_FALSE(status);
    EXPECT_THAT(status.error().message, HasSubstr("part.tif: is an input raster or a part of one"));
}

} // namespace
} // namespace marsview::test
