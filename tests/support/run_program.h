// Running other people's programs as oracles.
#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

namespace marsview::test {

struct ProgramOutput {
    int exit_status = -1; // 127 where the program is not installed
    std::string out;
    std::string err;
};

/// Runs `arguments[0]`, found on the PATH, with `input` on its standard input, and waits for it.
/// No shell sees the arguments. Output of any size; throws std::system_error where the machine has
/// no process or temporary file to give.
ProgramOutput runProgram(const std::vector<std::string>& arguments, const std::string& input = "");

/// As runProgram, for steps of a test that have to work: throws std::runtime_error with the
/// program's complaint where it exits with anything but 0.
std::string runTool(const std::vector<std::string>& arguments, const std::string& input = "");

/// A program that runs beside the test. What it prints goes into a file. Ended with its object.
class RunningProgram {
public:
    /// Begins; `arguments` as for runProgram. Throws std::system_error where there is no process.
    RunningProgram(const std::vector<std::string>& arguments, const std::string& printed);
    ~RunningProgram();
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    void signal(int number) const;
    /// Until then nobody has waited for it.
    bool hasEnded();
    /// The exit status; -1 where a signal ended it, 127 where the program is not installed.
    int wait();

private:
    pid_t child_ = -1; // -1 once it has been waited for
    int status_ = 0;
};

} // namespace marsview::test
