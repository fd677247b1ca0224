// Contracts of every command: the exit status, and which stream gets which output.
#include "tests/cli/run_cli.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace marsview::test {
namespace {

void expectUsageError(const std::vector<std::string>& arguments)
{
    const ProgramOutput output = runCli(arguments);
    EXPECT_EQ(output.exit_status, 2) << output.err;
    EXPECT_EQ(output.out, "");
    EXPECT_TRUE(output.err.starts_with("marsview-cli: ")) << output.err;
}

} // namespace

TEST(Program, RefusesWrongUsageWithStatusTwo)
{
    expectUsageError({});
    expectUsageError({"fly"});
    expectUsageError({"info"});
    expectUsageError({"devices", "everything"});
    expectUsageError({"info", bundledMars(), "--colour"});
    expectUsageError({"sample", bundledMars()});
    expectUsageError({"sample", bundledMars(), "--pixel", "1"});
    expectUsageError({"sample", bundledMars(), "--pixel", "1", "2", "--map", "1", "2"});
    expectUsageError({"sample", bundledMars(), "--pixel", "one", "2"});
    expectUsageError({"sample", bundledMars(), "--lonlat", "1", "2", "--latitude", "magnetic"});
}

TEST(Program, AnswersHelpAndVersionEverywhere)
{
    for (const std::vector<std::string>& command : {std::vector<std::string>{},
                                                    {"info"},
                                                    {"sample"},
                                                    {"devices"},
                                                    {"bench"},
                                                    {"bench", "view"}}) {
        for (const char* option : {"--help", "--version"}) {
            std::vector<std::string> arguments = command;
            arguments.emplace_back(option);
            const ProgramOutput output = runCli(arguments);
            EXPECT_EQ(output.exit_status, 0) << option;
            EXPECT_NE(output.out, "") << option;
            EXPECT_EQ(output.err, "") << option;
        }
    }
}

TEST(Program, FailsWithStatusOneAndNamesTheFileInOneLine)
{
    const TempFolder folder;
    const std::string missing = folder.file("nowhere.tif");
    const std::string empty = folder.write("empty.tif", "");
    const std::string junk = folder.write("junk.tif", "not a raster at all");
    for (const std::string& path : {missing, empty, junk, folder.path().string()}) {
        for (const std::vector<std::string>& arguments :
             {std::vector<std::string>{"info", path}, {"sample", path, "--pixel", "0", "0"}}) {
            const ProgramOutput output = runCli(arguments);
            EXPECT_EQ(output.exit_status, 1) << path;
            EXPECT_EQ(output.out, "") << path;
            EXPECT_TRUE(output.err.starts_with("marsview-cli: " + path + ": ")) << output.err;
            EXPECT_EQ(std::count(output.err.begin(), output.err.end(), '\n'), 1) << output.err;
        }
    }
}

TEST(Program, FailsWhereItsResultCannotBeWritten)
{
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"info", bundledMars()},
          {"sample", bundledMars(), "--pixel", "0", "0"},
          {"devices"}}) {
        std::vector<std::string> line{"sh", "-c", "\"$0\" \"$@\" > /dev/full", MARSVIEW_CLI};
        line.insert(line.end(), arguments.begin(), arguments.end());
        const ProgramOutput output = runProgram(line);
        EXPECT_EQ(output.exit_status, 1) << arguments.front();
        EXPECT_TRUE(output.err.ends_with("marsview-cli: stdout: writing the result failed\n"))
            << output.err;
    }
}

TEST(Program, DoesNotUseClosedStreams)
{
    const auto shell = [](const std::string& line) {
        return runProgram({"timeout", "60", "sh", "-c", line, MARSVIEW_CLI, bundledMars()});
    };
    const ProgramOutput input = shell("\"$0\" sample \"$1\" --stdin <&-");
    EXPECT_EQ(input.exit_status, 0) << input.err;
    EXPECT_EQ(input.out, "");
    for (const char* line : {"\"$0\" sample \"$1\" --pixel 0 0 >&-", "\"$0\" --help >&-"}) {
        const ProgramOutput output = shell(line);
        EXPECT_EQ(output.exit_status, 1) << line;
        EXPECT_TRUE(output.err.ends_with("stdout: writing the result failed\n")) << output.err;
    }
}

TEST(Program, NamesAnUnusableOverride)
{
    for (const auto& [option, value] :
         {std::pair{"--crs", "EPSG:999999"}, std::pair{"--body", "Arrakis"},
          std::pair{"--unit", "cubits"}}) {
        const ProgramOutput output = runCli({"info", bundledMars(), option, value});
        EXPECT_EQ(output.exit_status, 2);
        EXPECT_NE(output.err.find(value), std::string::npos) << output.err;
    }
}

} // namespace marsview::test
