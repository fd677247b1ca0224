// Running marsview-cli as a script would.
#pragma once

#include "tests/support/run_program.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace marsview::test {

/// Runs the program that was built beside the tests.
ProgramOutput runCli(std::vector<std::string> arguments, const std::string& input = "");

/// The same in an environment with these "NAME=value" besides; a "NAME" alone is taken away.
ProgramOutput runCliWith(const std::vector<std::string>& environment,
                         const std::vector<std::string>& arguments);

/// `info PATH --json`, parsed; throws where it fails.
nlohmann::json cliInfo(const std::string& path, const std::vector<std::string>& options = {});

/// The numbers printed one a line; "nan" as NaN.
std::vector<double> numbersIn(const std::string& text);

} // namespace marsview::test
