#include "core/base/child_program.h"

#include <gtest/gtest.h>

#include <csignal>
#include <string>

namespace marsview {
namespace {

ChildProgram shell(const std::string& script)
{
    ChildProgram program;
    program.path = "/bin/sh";
    program.arguments = {"-c", script};
    return program;
}

TEST(ChildProgram, ReportsOutputAndExitStatus)
{
    ChildProgram program = shell("cat; echo lost >&2; exit 3");
    program.input = std::string("one\0two", 7);
    const auto outcome = runChild(program);
    ASSERT_TRUE(outcome);
    EXPECT_EQ(outcome->end, ChildEnd::Exited);
    EXPECT_EQ(outcome->exit_status, 3);
    EXPECT_EQ(outcome->out, program.input);
    EXPECT_EQ(outcome->err, "lost\n");
}

TEST(ChildProgram, ReportsTheSignalThatKilledIt)
{
    const auto outcome = runChild(shell("kill -SEGV $$"));
    ASSERT_TRUE(outcome);
    EXPECT_EQ(outcome->end, ChildEnd::Killed);
    EXPECT_EQ(outcome->signal, SIGSEGV);
}

TEST(ChildProgram, KillsAProgramThatDoesNotEnd)
{
    ChildProgram program = shell("while :; do :; done");
    program.time_max = std::chrono::milliseconds(50);
    const auto late = runChild(program);
    ASSERT_TRUE(late);
    EXPECT_EQ(late->end, ChildEnd::TimedOut);
    program.time_max = std::chrono::hours(1);
    JobMonitor job;
    job.cancel();
    program.job = &job;
    const auto canceled = runChild(program);
    ASSERT_TRUE(canceled);
    EXPECT_EQ(canceled->end, ChildEnd::Canceled);
    // With its output streams closed.
    program = shell("exec >&- 2>&-; while :; do :; done");
    program.time_max = std::chrono::milliseconds(50);
    EXPECT_EQ(runChild(program)->end, ChildEnd::TimedOut);
}

TEST(ChildProgram, DropsOutputBeyondTheLimit)
{
    ChildProgram program = shell("head -c 1000000 /dev/zero; echo end >&2");
    program.output_bytes_max = 1000;
    const auto outcome = runChild(program);
    ASSERT_TRUE(outcome);
    EXPECT_EQ(outcome->out.size(), 1000U);
    EXPECT_EQ(outcome->err, "end\n");
}

TEST(ChildProgram, ReportsAMissingProgram)
{
    ChildProgram program;
    program.path = "/nonexistent/program";
    EXPECT_FALSE(runChild(program));
}

} // namespace
} // namespace marsview
