// Writes the manual pages and completions of a program.
#pragma once

#include "app/documents/program_document.h"
#include "core/base/result.h"

namespace marsview {

/// Into `folder`, which is created: man1/PROGRAM.1 and a page for each command, bash/PROGRAM,
/// zsh/_PROGRAM and fish/PROGRAM.fish. Existing files are replaced. `version` as "0.1.0". The error
/// names the file that cannot be written.
Status writeDocuments(const DocumentedCommand& program,
                      const std::string& folder,
                      std::string_view version);

} // namespace marsview
