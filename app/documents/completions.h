// Completion scripts for shells.
#pragma once

#include "app/documents/program_document.h"

namespace marsview {

/// Each completes commands, options, and after an option its choices, files or folders; without
/// an option files, where the command takes an argument.
std::string bashCompletion(const DocumentedCommand& program);
std::string zshCompletion(const DocumentedCommand& program);
std::string fishCompletion(const DocumentedCommand& program);

} // namespace marsview
