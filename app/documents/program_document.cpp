#include "app/documents/program_document.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace marsview {
namespace {

std::string valueName(std::string_view type)
{
    if (type == "FLOAT") {
        return "NUMBER";
    }
    if (type == "INT" || type == "UINT") {
        return "N";
    }
    return std::string(type);
}

// "TEXT:{tiles,strips}" names the choices.
void takeType(const std::string& type, DocumentedOption& option)
{
    const std::size_t colon = type.find(':');
    option.value = valueName(std::string_view(type).substr(0, colon));
    const std::size_t open = type.find(":{");
    const std::size_t close = type.find('}', open);
    if (open != std::string::npos && close != std::string::npos) {
        option.choices = CLI::detail::split(type.substr(open + 2, close - open - 2), ',');
    }
}

// The parser writes lists as "[1,2]".
std::string defaultOf(const CLI::Option& option)
{
    std::string text = option.get_default_str();
    if (text.starts_with('[') && text.ends_with(']')) {
        text = text.substr(1, text.size() - 2);
    }
    return text;
}

DocumentedOption documentOf(const CLI::Option& option)
{
    DocumentedOption documented;
    if (option.get_positional()) {
        documented.names = {option.get_name()};
    }
    for (const std::string& name : option.get_snames()) {
        documented.names.push_back("-" + name);
    }
    for (const std::string& name : option.get_lnames()) {
        documented.names.push_back("--" + name);
    }
    if (option.get_type_size_max() > 0) {
        takeType(option.get_type_name(), documented);
        documented.takes_several =
            option.get_items_expected_max() > 1 && documented.value.find(' ') == std::string::npos;
        documented.default_value = defaultOf(option);
    }
    documented.text = option.get_description();
    documented.is_required = option.get_required();
    return documented;
}

DocumentedCommand documentOf(const CLI::App& app, std::vector<std::string> path)
{
    path.push_back(app.get_name());
    DocumentedCommand command{.path = path,
                              .text = app.get_description(),
                              .arguments = {},
                              .groups = {{.title = "Options", .options = {}}},
                              .commands = {}};
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_positional()) {
            command.arguments.push_back(documentOf(*option));
            continue;
        }
        const std::string& title = option->get_group();
        auto group =
            std::find_if(command.groups.begin(), command.groups.end(),
                         [&title](const OptionGroup& known) { return known.title == title; });
        if (group == command.groups.end()) {
            group = command.groups.insert(command.groups.end(), {.title = title, .options = {}});
        }
        group->options.push_back(documentOf(*option));
    }
    for (const CLI::App* below : app.get_subcommands([](const CLI::App*) { return true; })) {
        command.commands.push_back(documentOf(*below, path));
    }
    return command;
}

} // namespace

DocumentedCommand documentOf(const CLI::App& program)
{
    return documentOf(program, {});
}

std::string joined(const std::vector<std::string>& words, std::string_view separator)
{
    return fmt::format("{}", fmt::join(words, separator));
}

std::vector<const DocumentedCommand*> allCommands(const DocumentedCommand& command)
{
    std::vector<const DocumentedCommand*> all{&command};
    for (const DocumentedCommand& below : command.commands) {
        const std::vector<const DocumentedCommand*> more = allCommands(below);
        all.insert(all.end(), more.begin(), more.end());
    }
    return all;
}

} // namespace marsview
