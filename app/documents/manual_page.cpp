#include "app/documents/manual_page.h"

#include "app/documents/program_facts.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <span>

namespace marsview {
namespace {

std::string escaped(std::string_view text)
{
    std::string roff;
    if (text.starts_with('.')) {
        roff = "\\&"; // or it would be a request
    }
    for (const char c : text) {
        switch (c) {
        case '\\':
            roff += "\\e";
            break;
        case '-':
            roff += "\\-";
            break;
        case '~':
            roff += "\\(ti";
            break;
        case '^':
            roff += "\\(ha";
            break;
        case '`':
            roff += "\\(ga";
            break;
        case '\'':
            roff += "\\(aq";
            break;
        default:
            roff += c;
        }
    }
    return roff;
}

std::string bold(std::string_view text)
{
    return "\\fB" + escaped(text) + "\\fR";
}

std::string italic(std::string_view text)
{
    return "\\fI" + escaped(text) + "\\fR";
}

// A page's name in references.
std::string pageName(const DocumentedCommand& command)
{
    return joined(command.path, "-");
}

// Help texts are half sentences. A symbol at the start ("x0") stays as it is.
std::string asSentence(std::string_view text)
{
    std::string sentence(text);
    const auto is_letter = [](unsigned char c) { return std::isalpha(c) != 0; };
    const auto word_end = std::find(sentence.begin(), sentence.end(), ' ');
    if (std::all_of(sentence.begin(), word_end, is_letter) && !sentence.empty()) {
        sentence.front() =
            static_cast<char>(std::toupper(static_cast<unsigned char>(sentence.front())));
    }
    if (!sentence.empty() && !sentence.ends_with('.') && !sentence.ends_with("…")) {
        sentence += '.';
    }
    return sentence;
}

// The first sentence, as the list of pages (whatis) has it.
std::string summaryOf(const DocumentedCommand& command)
{
    std::string summary = command.text.substr(0, command.text.find(". "));
    if (summary.ends_with('.')) {
        summary.pop_back();
    }
    if (!summary.empty()) {
        summary.front() =
            static_cast<char>(std::tolower(static_cast<unsigned char>(summary.front())));
    }
    return summary;
}

std::string valueOf(const DocumentedOption& option)
{
    return italic(option.value) + (option.takes_several ? " ..." : "");
}

std::string withNames(const DocumentedOption& option)
{
    std::string head;
    for (const std::string& name : option.names) {
        head += (head.empty() ? "" : ", ") + bold(name);
    }
    return option.value.empty() ? head : head + " " + valueOf(option);
}

std::string synopsisOf(const DocumentedCommand& command)
{
    std::string line = bold(joined(command.path, " "));
    if (!command.commands.empty()) {
        line += " " + italic("COMMAND");
    }
    line += " [" + italic("OPTIONS") + "]";
    for (const OptionGroup& group : command.groups) {
        for (const DocumentedOption& option : group.options) {
            if (option.is_required) {
                line += " " + bold(option.names.back()) + " " + valueOf(option);
            }
        }
    }
    for (const DocumentedOption& argument : command.arguments) {
        const std::string name =
            italic(argument.names.front()) + (argument.takes_several ? " ..." : "");
        line += argument.is_required ? " " + name : " [" + name + "]";
    }
    return line + "\n";
}

std::string entry(const std::string& head, std::string_view text)
{
    return ".TP\n" + head + "\n" + escaped(text) + "\n";
}

std::string optionEntry(const DocumentedOption& option)
{
    std::string text = asSentence(option.text);
    if (!option.choices.empty()) {
        text += " One of: " + joined(option.choices, ", ") + ".";
    }
    if (!option.default_value.empty()) {
        text += " Default: " + option.default_value + ".";
    }
    if (option.is_required) {
        text += " Required.";
    }
    return entry(withNames(option), text);
}

std::string optionsOf(const DocumentedCommand& command)
{
    std::string section = ".SH OPTIONS\n";
    for (const OptionGroup& group : command.groups) {
        if (&group != &command.groups.front()) {
            section += ".SS \"" + escaped(group.title) + "\"\n";
        }
        for (const DocumentedOption& option : group.options) {
            section += optionEntry(option);
        }
    }
    return section;
}

std::string factsSection(std::string_view title, std::span<const DocumentedFact> facts)
{
    std::string section = fmt::format(".SH \"{}\"\n", title);
    for (const DocumentedFact& fact : facts) {
        section += entry(bold(fact.name), fact.text);
    }
    return section;
}

std::string argumentsOf(const DocumentedCommand& command)
{
    std::string entries;
    for (const DocumentedOption& argument : command.arguments) {
        entries += entry(italic(argument.names.front()), asSentence(argument.text));
    }
    return entries;
}

std::string commandsOf(const DocumentedCommand& command)
{
    std::string section = ".SH COMMANDS\n";
    for (const DocumentedCommand& below : command.commands) {
        section += entry(bold(pageName(below)) + "(1)", asSentence(below.text));
    }
    return section;
}

std::string seeAlsoOf(const DocumentedCommand& program, const DocumentedCommand& command)
{
    std::vector<std::string> pages;
    for (const DocumentedCommand* other : allCommands(program)) {
        if (other != &command) {
            pages.push_back(bold(pageName(*other)) + "(1)");
        }
    }
    for (const char* other : {"marsview", "gdalinfo"}) {
        if (program.path.front() != other) {
            pages.push_back(bold(other) + "(1)");
        }
    }
    if (program.path.front() == "marsview") {
        pages.insert(pages.begin(), bold("marsview-cli") + "(1)");
    }
    return ".SH \"SEE ALSO\"\n" + joined(pages, ",\n") + "\n";
}

std::string descriptionOf(const DocumentedCommand& program, const DocumentedCommand& command)
{
    std::string section = ".SH DESCRIPTION\n" + escaped(asSentence(command.text)) + "\n";
    if (&program == &command && !program.commands.empty()) {
        for (const std::string_view paragraph : commandConventions()) {
            section += ".PP\n" + escaped(paragraph) + "\n";
        }
    }
    return section + argumentsOf(command);
}

} // namespace

std::string manualPageFile(const DocumentedCommand& command)
{
    return pageName(command) + ".1";
}

std::string manualPage(const DocumentedCommand& program,
                       const DocumentedCommand& command,
                       std::string_view version)
{
    std::string name = pageName(command);
    std::string title = name;
    std::transform(title.begin(), title.end(), title.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    std::string page = fmt::format(".TH \"{}\" 1 \"\" \"MarsView {}\" \"User Commands\"\n",
                                   escaped(title), version);
    page += ".SH NAME\n" + escaped(name) + " \\- " + escaped(summaryOf(command)) + "\n";
    page += ".SH SYNOPSIS\n" + synopsisOf(command);
    page += descriptionOf(program, command);
    if (!command.commands.empty()) {
        page += commandsOf(command);
    }
    page += optionsOf(command);
    page += factsSection("EXIT STATUS", exitStatuses());
    if (&program == &command) {
        page += factsSection("ENVIRONMENT", environmentVariables());
        page += factsSection("FILES", usedFiles());
    } else {
        page += ".SH ENVIRONMENT\nVariables and files are listed in " + bold(pageName(program)) +
                "(1).\n";
    }
    return page + seeAlsoOf(program, command);
}

} // namespace marsview
