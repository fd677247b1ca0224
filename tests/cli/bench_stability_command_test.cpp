#include "tests/cli/run_cli.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace marsview::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(BenchStabilityCommand, PlotsTheGesturesOfThePaper)
{
    const TempFolder folder;
    const ProgramOutput output = runCli({"bench", "stability", "--plots", folder.path().string()});
    ASSERT_EQ(output.exit_status, 0) << output.err;
    const auto plot = [&](const char* name) { return readFile(folder.file(name)); };
    EXPECT_THAT(plot("pan.svg"), HasSubstr("map moved by the hand, m"));
    EXPECT_THAT(plot("fling-into-a-limit.svg"), HasSubstr("map moved by the hand, m"));
    EXPECT_THAT(plot("zoom-in.svg"), HasSubstr("map enlarged by the hand, octaves"));
    EXPECT_THAT(plot("zoom-out.svg"), HasSubstr("map enlarged by the hand, octaves"));
    EXPECT_THAT(plot("ratchets.svg"), HasSubstr("map enlarged by the hand, octaves"));
    EXPECT_THAT(plot("twist.svg"), AllOf(HasSubstr("map turned by the hand, °"),
                                         Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
}

TEST(BenchStabilityCommand, SaysWhichPlotCannotBeWritten)
{
    const ProgramOutput output = runCli({"bench", "stability", "--plots", "/nowhere"});
    EXPECT_EQ(output.exit_status, 1);
    EXPECT_THAT(output.err, HasSubstr("/nowhere/pan.svg: cannot be written"));
}

} // namespace
} // namespace marsview::test
