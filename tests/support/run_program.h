// Running other programs as oracles.
#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

namespace marsview::test {

struct ProgramOutput {
    int exit_status = -1; // 127 if the program is not installed
    std::string out;
    std::string err;
};

/// Runs `arguments[0]`, found on the PATH, with `input` on its standard input, and waits for it. No
/// shell parses the arguments. Output of any size; throws std::system_error if the machine cannot
/// provide a process or a temporary file.
ProgramOutput runProgram(const std::vector<std::string>& arguments, const std::string& input = "");

/// As runProgram, for steps of a test that must succeed: throws std::runtime_error with the
/// program's error output if the exit status is not 0.
std::string runTool(const std::vector<std::string>& arguments, const std::string& input = "");

/// A program that runs in parallel with the test. Its output goes to a file. Ended by the
/// destructor.
class RunningProgram {
public:
    /// Starts the program; `arguments` as for runProgram. Throws std::system_error if no process
    /// can be created.
    RunningProgram(const std::vector<std::string>& arguments, const std::string& printed);
    ~RunningProgram();
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    void signal(int number) const;
    /// Whether the program has ended. Does not wait.
    bool hasEnded();
    /// Waits; the exit status, -1 if a signal ended the program, 127 if it is not installed.
    int wait();

private:
    pid_t child_ = -1; // -1 after wait
    int status_ = 0;
};

} // namespace marsview::test
