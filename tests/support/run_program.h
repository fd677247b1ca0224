// Running other people's programs as oracles.
#pragma once

#include <string>
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

} // namespace marsview::test
