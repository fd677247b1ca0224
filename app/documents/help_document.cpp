// Documents of a program from the help that it prints.

#include "app/documents/program_document.h"

#include <sstream>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kIndentMax = 4; // deeper lines continue the one above

std::string_view trimmed(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(' ');
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

// "-h, --help" or "--size WxH" or "DEM"
DocumentedOption optionFrom(std::string_view words, std::string_view text)
{
    DocumentedOption option;
    option.text = text;
    std::istringstream stream{std::string(words)};
    for (std::string word; stream >> word;) {
        if (word.ends_with(',')) {
            word.pop_back();
        }
        if (word.starts_with('-') || option.names.empty()) {
            option.names.push_back(word);
        } else {
            option.value = word;
        }
    }
    return option;
}

class HelpReader {
public:
    explicit HelpReader(std::string_view program)
    {
        command_.path = {std::string(program)};
        command_.groups = {{.title = "Options", .options = {}}};
    }

    void take(const std::string& line)
    {
        const std::size_t indent = line.find_first_not_of(' ');
        if (indent == std::string::npos) {
            entry_ = nullptr;
        } else if (line.starts_with("Usage:")) {
            usage_ = line;
        } else if (indent > kIndentMax && entry_ != nullptr) {
            entry_->text += " " + std::string(trimmed(line));
        } else if (const std::size_t gap = line.find("  ", indent); gap != std::string::npos) {
            addEntry(optionFrom(trimmed(std::string_view(line).substr(0, gap)),
                                trimmed(std::string_view(line).substr(gap))));
        } else if (!line.ends_with(':')) {
            command_.text += (command_.text.empty() ? "" : " ") + line;
        }
    }

    DocumentedCommand finish()
    {
        for (DocumentedOption& argument : command_.arguments) {
            argument.value = kFileValue;
            argument.is_required = usage_.find("[" + argument.names.front()) == std::string::npos;
            argument.takes_several =
                usage_.find(argument.names.front() + "...") != std::string::npos;
        }
        return std::move(command_);
    }

private:
    void addEntry(DocumentedOption option)
    {
        std::vector<DocumentedOption>& entries = option.names.front().starts_with('-')
                                                     ? command_.groups.front().options
                                                     : command_.arguments;
        entries.push_back(std::move(option));
        entry_ = &entries.back();
    }

    DocumentedCommand command_;
    std::string usage_;
    DocumentedOption* entry_ = nullptr; // whose text may continue
};

} // namespace

DocumentedCommand documentOfHelp(std::string_view program, std::string_view help)
{
    HelpReader reader(program);
    std::istringstream lines{std::string(help)};
    for (std::string line; std::getline(lines, line);) {
        reader.take(line);
    }
    return reader.finish();
}

} // namespace marsview
