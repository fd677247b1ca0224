#include "app/documents/completions.h"

#include <algorithm>
#include <fmt/format.h>

namespace marsview {
namespace {

std::string quoted(std::string_view text)
{
    std::string word = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') {
            word += '\\';
        }
        word += c;
    }
    return word + "'";
}

std::string functionName(const DocumentedCommand& program)
{
    std::string name = "__" + program.path.front() + "_command";
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

// A function that prints the command whose words are typed.
std::string commandFunction(const DocumentedCommand& program)
{
    std::string cases;
    for (const DocumentedCommand* command : allCommands(program)) {
        if (command != &program) {
            cases += " " + quoted(joined(command->path, " "));
        }
    }
    const std::string descent = cases.empty()
                                    ? std::string()
                                    : fmt::format(
                                          "    for word in (commandline -opc)\n"
                                          "        switch \"$command $word\"\n"
                                          "            case{}\n"
                                          "                set command \"$command $word\"\n"
                                          "        end\n"
                                          "    end\n",
                                          cases);
    return fmt::format("function {}\n    set -l command {}\n{}    echo $command\nend\n",
                       functionName(program), program.path.front(), descent);
}

std::string valueOf(const DocumentedOption& option)
{
    if (option.value.empty()) {
        return "";
    }
    if (!option.choices.empty()) {
        return " -x -a " + quoted(joined(option.choices, " "));
    }
    if (option.value == kFileValue) {
        return " -r -F";
    }
    return option.value == kFolderValue ? " -x -a '(__fish_complete_directories)'" : " -x";
}

std::string linesOf(const DocumentedCommand& program, const DocumentedCommand& command)
{
    const std::string start =
        fmt::format("complete -c {} -n \"test ({}) = '{}'\"", program.path.front(),
                    functionName(program), joined(command.path, " "));
    std::string lines;
    for (const DocumentedCommand& below : command.commands) {
        lines += fmt::format("{} -a {} -d {}\n", start, below.path.back(), quoted(below.text));
    }
    for (const OptionGroup& group : command.groups) {
        for (const DocumentedOption& option : group.options) {
            std::string names;
            for (const std::string& name : option.names) {
                names += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            }
            lines += start + names + valueOf(option) + " -d " + quoted(option.text) + "\n";
        }
    }
    return command.arguments.empty() ? lines : lines + start + " -F\n";
}

} // namespace

std::string fishCompletion(const DocumentedCommand& program)
{
    std::string script =
        fmt::format("# fish completion for {}, written from its help\n", program.path.front());
    script += commandFunction(program);
    script += fmt::format("complete -c {} -f\n", program.path.front());
    for (const DocumentedCommand* command : allCommands(program)) {
        script += linesOf(program, *command);
    }
    return script;
}

} // namespace marsview
