// Manual pages in roff.
#pragma once

#include "app/documents/program_document.h"

namespace marsview {

/// The page of `command`, which is `program` or one of its commands. `version` as "0.1.0".
std::string manualPage(const DocumentedCommand& program,
                       const DocumentedCommand& command,
                       std::string_view version);

/// "marsview-cli-bench-view.1"
std::string manualPageFile(const DocumentedCommand& command);

} // namespace marsview
