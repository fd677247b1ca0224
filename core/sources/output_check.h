// Checks whether output files would overwrite input files.
#pragma once

#include "core/base/result.h"
#include "core/files/shared_file.h"

#include <string>
#include <vector>

namespace marsview {

/// The files that a command reads and writes; empty paths and devices are ignored.
struct FilesInUse {
    std::vector<std::string> maps; // each with all its files
    std::vector<std::string> read;
    std::vector<std::string> written;
};

/// Invalid if an output file is also an input file, under any name or link, or is written twice.
/// Call before anything is written. Returns the open files of the maps, if it had to look into
/// them: while the caller keeps them, opening the maps does not open them again. Any thread.
Result<OpenFiles> checkOutputs(const FilesInUse& files);

} // namespace marsview
