// Running marsview-cli as a script would.
#pragma once

#include "tests/support/run_program.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace marsview::test {

/// Runs the program from the build tree of the tests.
ProgramOutput runCli(std::vector<std::string> arguments, const std::string& input = "");

/// The same with these "NAME=value" entries added to the environment; a plain "NAME" is removed
/// from it.
ProgramOutput runCliWith(const std::vector<std::string>& environment,
                         const std::vector<std::string>& arguments);

/// The parsed output of `info PATH --json`; throws if the command fails.
nlohmann::json cliInfo(const std::string& path, const std::vector<std::string>& options = {});

/// The numbers printed one per line; "nan" gives NaN.
std::vector<double> numbersIn(const std::string& text);

} // namespace marsview::test
