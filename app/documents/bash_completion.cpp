#include "app/documents/completions.h"

#include <algorithm>
#include <fmt/format.h>

namespace marsview {
namespace {

constexpr const char* kStart = R"(# bash completion for {0}, written from its help
{1}()
{{
    local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}
    local command={0} words="" files=""
    COMPREPLY=()
    # --option=value arrives as three words.
    if [[ $current == "=" ]]; then
        current=""
    elif [[ $before == "=" ]] && ((COMP_CWORD >= 2)); then
        before=${{COMP_WORDS[COMP_CWORD - 2]}}
    fi
)";

constexpr const char* kEnd = R"(    if [[ $files != no ]]; then
        mapfile -t COMPREPLY < <(compgen $files -- "$current")
        compopt -o filenames 2>/dev/null
    else
        mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
    fi
}}
complete -F {1} {0}
)";

std::string functionName(const DocumentedCommand& program)
{
    std::string name = "_" + program.path.front();
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

// The words that lead from one command to the one below.
std::string descent(const DocumentedCommand& program)
{
    std::string patterns;
    for (const DocumentedCommand* command : allCommands(program)) {
        if (command != &program) {
            patterns +=
                (patterns.empty() ? "" : " | ") + fmt::format("\"{}\"", joined(command->path, " "));
        }
    }
    if (patterns.empty()) {
        return {};
    }
    return fmt::format(
        "    local word\n"
        "    for word in \"${{COMP_WORDS[@]:1:COMP_CWORD-1}}\"; do\n"
        "        case \"$command $word\" in\n"
        "            {}) command+=\" $word\" ;;\n"
        "        esac\n"
        "    done\n",
        patterns);
}

// The completions after the option, as assignments of the script.
std::string answerTo(const DocumentedOption& option)
{
    if (!option.choices.empty()) {
        return fmt::format("files=no words=\"{}\"", joined(option.choices, " "));
    }
    if (option.value == kFileValue) {
        return "files=-f";
    }
    return option.value == kFolderValue ? "files=-d" : "return";
}

std::string valuesOf(const DocumentedCommand& command)
{
    std::string cases;
    for (const OptionGroup& group : command.groups) {
        for (const DocumentedOption& option : group.options) {
            if (option.value.empty()) {
                continue;
            }
            std::string patterns;
            for (const std::string& name : option.names) {
                patterns += (patterns.empty() ? "" : " | ") +
                            fmt::format("\"{} {}\"", joined(command.path, " "), name);
            }
            cases += fmt::format("        {}) {} ;;\n", patterns, answerTo(option));
        }
    }
    return cases;
}

std::string wordsOf(const DocumentedCommand& command)
{
    std::string options;
    for (const OptionGroup& group : command.groups) {
        for (const DocumentedOption& option : group.options) {
            options += (options.empty() ? "" : " ") + joined(option.names, " ");
        }
    }
    std::string commands;
    for (const DocumentedCommand& below : command.commands) {
        commands += (commands.empty() ? "" : " ") + below.path.back();
    }
    const bool has_files = !command.arguments.empty();
    return fmt::format(
        "            \"{}\")\n"
        "                if [[ $current == -* ]]; then\n"
        "                    files=no words=\"{}\"\n"
        "                else\n"
        "                    {}\n"
        "                fi\n"
        "                ;;\n",
        joined(command.path, " "), options,
        has_files ? "files=-f" : fmt::format("files=no words=\"{}\"", commands));
}

} // namespace

std::string bashCompletion(const DocumentedCommand& program)
{
    const std::string& name = program.path.front();
    std::string script = fmt::format(kStart, name, functionName(program));
    script += descent(program);
    script += "    case \"$command $before\" in\n";
    for (const DocumentedCommand* command : allCommands(program)) {
        script += valuesOf(*command);
    }
    script += "    esac\n    if [[ -z $files ]]; then\n        case \"$command\" in\n";
    for (const DocumentedCommand* command : allCommands(program)) {
        script += wordsOf(*command);
    }
    script += "        esac\n    fi\n";
    return script + fmt::format(kEnd, name, functionName(program));
}

} // namespace marsview
