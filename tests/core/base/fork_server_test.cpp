#include "core/base/child_program.h"
#include "core/base/fork_server.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

namespace marsview {
namespace {

void print(int to, const std::string& text)
{
    const ssize_t ignored = write(to, text.data(), text.size());
    (void)ignored;
}

int childMain(const std::vector<std::string>& arguments)
{
    const std::string& task = arguments.at(0);
    if (task == "hang") {
        close(STDOUT_FILENO);
        close(STDERR_FILENO);
        while (true) {
            pause();
        }
    }
    if (task == "crash") {
        std::signal(SIGSEGV, SIG_DFL); // sanitizers have a handler of their own
        std::raise(SIGSEGV);
    }
    if (task == "throw") {
        throw std::runtime_error("lost");
    }
    std::array<char, 64> input{};
    const ssize_t bytes = read(STDIN_FILENO, input.data(), input.size());
    print(STDOUT_FILENO, std::filesystem::current_path().string() + "\n" +
                             std::string(input.data(), static_cast<std::size_t>(bytes)));
    print(STDERR_FILENO, "lost\n");
    return std::stoi(task);
}

// Without a server it would fail: there is no such program.
ChildProgram childThat(const std::string& task)
{
    static const bool is_started = [] {
        startForkServer(&childMain);
        return true;
    }();
    (void)is_started;
    ChildProgram program;
    program.path = "/nonexistent/program";
    program.may_be_forked = true;
    program.arguments = {task, "more"};
    return program;
}

} // namespace

TEST(ForkServer, RunsItsFunctionAsAProgramWouldRun)
{
    for (const std::filesystem::path folder : {"/", "/tmp"}) {
        std::filesystem::current_path(folder);
        ChildProgram program = childThat("3");
        program.input = std::string("one\0two", 7);
        const auto outcome = runChild(program);
        ASSERT_TRUE(outcome) << outcome.error().message;
        EXPECT_EQ(outcome->end, ChildEnd::Exited);
        EXPECT_EQ(outcome->exit_status, 3);
        EXPECT_EQ(outcome->out, folder.string() + "\n" + program.input);
        EXPECT_EQ(outcome->err, "lost\n");
    }
}

TEST(ForkServer, OutlivesChildrenThatCrash)
{
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(runChild(childThat("crash"))->signal, SIGSEGV);
        EXPECT_EQ(runChild(childThat("throw"))->signal, SIGABRT);
    }
    EXPECT_EQ(runChild(childThat("0"))->exit_status, 0);
}

TEST(ForkServer, KillsAChildThatDoesNotEnd)
{
    ChildProgram program = childThat("hang");
    program.time_max = std::chrono::milliseconds(50);
    EXPECT_EQ(runChild(program)->end, ChildEnd::TimedOut);
    program.time_max = std::chrono::hours(1);
    JobMonitor job;
    job.cancel();
    ChildProgram canceled = childThat("0");
    canceled.job = &job;
    EXPECT_EQ(runChild(canceled)->end, ChildEnd::Canceled);
}

TEST(ForkServer, ServesManyThreads)
{
    (void)childThat("0");
    std::array<int, 8> sums{};
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = 0; i < sums.size(); ++i) {
            threads.emplace_back([i, &sums] {
                for (int k = 0; k < 10; ++k) {
                    sums[i] += runChild(childThat(std::to_string(i + 1)))->exit_status;
                }
            });
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
        EXPECT_EQ(sums[i], 10 * static_cast<int>(i + 1));
    }
}

} // namespace marsview
