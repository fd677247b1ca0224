// Whether what is going to be written would take something away.
#pragma once

#include "core/base/result.h"

#include <string>
#include <vector>

namespace marsview {

/// What somebody reads and writes; empty paths are none, and devices lose nothing.
struct FilesInUse {
    std::vector<std::string> maps; // each with all the files that it is made of
    std::vector<std::string> read;
    std::vector<std::string> written;
};

/// Invalid where something that is written is something that is read, by whatever name and link, or
/// is written twice. To be asked before anything is written. Any thread.
Status checkOutputs(const FilesInUse& files);

} // namespace marsview
