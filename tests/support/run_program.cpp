#include "tests/support/run_program.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <memory>
#include <stdexcept>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace marsview::test {
namespace {

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

// Files instead of pipes, so that output of any size cannot block either side.
File temporaryFile()
{
    File file(std::tmpfile());
    if (!file) {
        throw std::system_error(errno, std::generic_category(), "temporary file");
    }
    return file;
}

std::string contents(std::FILE* file)
{
    std::string text;
    std::array<char, 1 << 16> buffer{};
    std::rewind(file);
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file)) {
        text.append(buffer.data(), count);
    }
    return text;
}

// Null-terminated; execvp does not modify the arguments.
std::vector<char*> argvOf(const std::vector<std::string>& arguments)
{
    std::vector<char*> argv;
    for (const std::string& argument : arguments) {
        argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    return argv;
}

} // namespace

ProgramOutput runProgram(const std::vector<std::string>& arguments, const std::string& input)
{
    const File in = temporaryFile();
    const File out = temporaryFile();
    const File err = temporaryFile();
    std::fwrite(input.data(), 1, input.size(), in.get());
    std::rewind(in.get());

    const std::vector<char*> argv = argvOf(arguments);
    const pid_t child = fork();
    if (child < 0) {
        throw std::system_error(errno, std::generic_category(), "fork");
    }
    if (child == 0) {
        dup2(fileno(in.get()), STDIN_FILENO);
        dup2(fileno(out.get()), STDOUT_FILENO);
        dup2(fileno(err.get()), STDERR_FILENO);
        execvp(argv[0], argv.data());
        _exit(127);
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) {
            throw std::system_error(errno, std::generic_category(), "waitpid");
        }
    }
    return {.exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
            .out = contents(out.get()),
            .err = contents(err.get())};
}

std::string runTool(const std::vector<std::string>& arguments, const std::string& input)
{
    ProgramOutput output = runProgram(arguments, input);
    if (output.exit_status != 0) {
        std::string command;
        for (const std::string& argument : arguments) {
            command += argument + " ";
        }
        throw std::runtime_error(command + "exited with " + std::to_string(output.exit_status) +
                                 ": " + output.err);
    }
    return std::move(output.out);
}

RunningProgram::RunningProgram(const std::vector<std::string>& arguments,
                               const std::string& printed)
{
    const std::vector<char*> argv = argvOf(arguments);
    child_ = fork();
    if (child_ < 0) {
        throw std::system_error(errno, std::generic_category(), "fork");
    }
    if (child_ == 0) {
        const int out = open(printed.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
        dup2(out, STDOUT_FILENO);
        dup2(out, STDERR_FILENO);
        execvp(argv[0], argv.data());
        _exit(127);
    }
}

RunningProgram::~RunningProgram()
{
    if (child_ > 0) {
        signal(SIGKILL);
        wait();
    }
}

void RunningProgram::signal(int number) const
{
    if (child_ > 0) {
        kill(child_, number);
    }
}

bool RunningProgram::hasEnded()
{
    if (child_ > 0 && waitpid(child_, &status_, WNOHANG) != 0) {
        child_ = -1;
    }
    return child_ < 0;
}

int RunningProgram::wait()
{
    if (child_ > 0) {
        waitpid(child_, &status_, 0);
        child_ = -1;
    }
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
}

} // namespace marsview::test
