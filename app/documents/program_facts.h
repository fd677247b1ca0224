// What manual pages say besides a program's help: exit statuses, environment, files.
#pragma once

#include <span>
#include <string_view>

namespace marsview {

struct DocumentedFact {
    std::string_view name;
    std::string_view text;
};

/// Of both programs.
std::span<const DocumentedFact> exitStatuses();
std::span<const DocumentedFact> environmentVariables();
std::span<const DocumentedFact> usedFiles();
/// Paragraphs on what holds for every command of marsview-cli.
std::span<const std::string_view> commandConventions();

} // namespace marsview
