#include "app/documents/completions.h"

#include <fmt/format.h>

namespace marsview {
namespace {

// Between single quotes, in a place where `special` characters have to be escaped.
std::string quoted(std::string_view text, std::string_view special)
{
    std::string word;
    for (const char c : text) {
        if (c == '\'') {
            word += "'\\''";
            continue;
        }
        if (special.find(c) != std::string_view::npos) {
            word += '\\';
        }
        word += c;
    }
    return word;
}

std::string functionName(const DocumentedCommand& command)
{
    return "_" + joined(command.path, "-");
}

std::string actionFor(const DocumentedOption& option)
{
    if (!option.choices.empty()) {
        return "(" + joined(option.choices, " ") + ")";
    }
    if (option.value == kFileValue) {
        return "_files";
    }
    return option.value == kFolderValue ? "_files -/" : " ";
}

std::string specsOf(const DocumentedOption& option)
{
    const bool has_value = !option.value.empty();
    std::string specs;
    for (const std::string& name : option.names) {
        const bool is_long = name.starts_with("--");
        specs += fmt::format(
            " \\\n        '({}){}{}[{}]{}'", joined(option.names, " "), name,
            has_value ? (is_long ? "=" : "+") : "", quoted(option.text, "[]\\"),
            has_value ? fmt::format(":{}:{}", quoted(option.value, ":"), actionFor(option)) : "");
    }
    return specs;
}

std::string argumentSpec(const DocumentedOption& argument)
{
    return fmt::format(" \\\n        '{}:{}:_files'", argument.takes_several ? "*" : "1",
                       quoted(argument.names.front(), ":"));
}

std::string chooserOf(const DocumentedCommand& command)
{
    std::string names;
    std::string cases;
    for (const DocumentedCommand& below : command.commands) {
        names +=
            fmt::format("\n                '{}:{}'", below.path.back(), quoted(below.text, ":\\"));
        cases += fmt::format("\n                {}) {} && ret=0 ;;", below.path.back(),
                             functionName(below));
    }
    return fmt::format(
        "    case $state in\n"
        "        command)\n"
        "            local -a commands=({}\n"
        "            )\n"
        "            _describe command commands && ret=0\n"
        "            ;;\n"
        "        arguments)\n"
        "            case $line[1] in{}\n"
        "            esac\n"
        "            ;;\n"
        "    esac\n",
        names, cases);
}

std::string functionOf(const DocumentedCommand& command)
{
    const bool has_commands = !command.commands.empty();
    std::string function = functionName(command) +
                           "() {\n"
                           "    local state line ret=1\n"
                           "    typeset -A opt_args\n"
                           "    _arguments -C";
    for (const OptionGroup& group : command.groups) {
        for (const DocumentedOption& option : group.options) {
            function += specsOf(option);
        }
    }
    for (const DocumentedOption& argument : command.arguments) {
        function += argumentSpec(argument);
    }
    if (has_commands) {
        function += " \\\n        '1: :->command' \\\n        '*:: :->arguments'";
    }
    function += " && ret=0\n";
    if (has_commands) {
        function += chooserOf(command);
    }
    return function + "    return ret\n}\n";
}

} // namespace

std::string zshCompletion(const DocumentedCommand& program)
{
    std::string script = fmt::format("#compdef {}\n", program.path.front());
    for (const DocumentedCommand* command : allCommands(program)) {
        script += "\n" + functionOf(*command);
    }
    return script + fmt::format("\n{} \"$@\"\n", functionName(program));
}

} // namespace marsview
