#include "tests/cli/run_cli.h"

#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace marsview::test {

ProgramOutput runCli(std::vector<std::string> arguments, const std::string& input)
{
    arguments.insert(arguments.begin(), MARSVIEW_CLI);
    return runProgram(arguments, input);
}

ProgramOutput runCliWith(const std::vector<std::string>& environment,
                         const std::vector<std::string>& arguments)
{
    std::vector<std::string> line{"env"};
    for (const std::string& name : environment) {
        if (name.find('=') == std::string::npos) {
            line.insert(line.begin() + 1, {"-u", name}); // options come first
        }
    }
    for (const std::string& variable : environment) {
        if (variable.find('=') != std::string::npos) {
            line.push_back(variable);
        }
    }
    line.emplace_back(MARSVIEW_CLI);
    line.insert(line.end(), arguments.begin(), arguments.end());
    return runProgram(line);
}

nlohmann::json cliInfo(const std::string& path, const std::vector<std::string>& options)
{
    std::vector<std::string> arguments{"info", path, "--json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramOutput output = runCli(arguments);
    if (output.exit_status != 0) {
        throw std::runtime_error(output.err);
    }
    return nlohmann::json::parse(output.out);
}

std::vector<double> numbersIn(const std::string& text)
{
    std::vector<double> numbers;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        numbers.push_back(std::stod(line));
    }
    return numbers;
}

} // namespace marsview::test
