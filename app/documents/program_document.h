// The content of a command's documents: its manual page and completions are written from it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace marsview {

/// `value` of options and arguments that name a file, and of those that name a folder.
inline constexpr std::string_view kFileValue = "FILE";
inline constexpr std::string_view kFolderValue = "FOLDER";

struct DocumentedOption {
    std::vector<std::string> names; // with dashes; of an argument its one name
    std::string value;              // "FILE", "NUMBER", …; empty for a flag
    std::vector<std::string> choices;
    std::string default_value; // empty: none
    std::string text;
    bool is_required = false;
    bool takes_several = false; // values
};

struct OptionGroup {
    std::string title;
    std::vector<DocumentedOption> options;
};

struct DocumentedCommand {
    std::vector<std::string> path; // {"marsview-cli", "bench", "view"}
    std::string text;
    std::vector<DocumentedOption> arguments;
    std::vector<OptionGroup> groups; // the first one is the general one
    std::vector<DocumentedCommand> commands;
};

/// The program of this parser with all its commands.
DocumentedCommand documentOf(const CLI::App& program);

/// A program that prints its help in this form, an argument or option a line, each followed by at
/// least two blanks and its text, which may continue on indented lines:
///
///     What it does.
///     Usage: program [OPTIONS] [DEM...]
///
///     DEM            maps to open
///
///     Options:
///       --size WxH   size of the window
///
/// Its arguments are files.
DocumentedCommand documentOfHelp(std::string_view program, std::string_view help);

/// The words of a path with `separator` between them.
std::string joined(const std::vector<std::string>& words, std::string_view separator);

/// `command` and everything below it, parents first.
std::vector<const DocumentedCommand*> allCommands(const DocumentedCommand& command);

} // namespace marsview
