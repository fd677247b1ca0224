// Finds the files installed with the program.
#pragma once

#include <filesystem>

namespace marsview {

/// Path of an installed file such as "devices/polhem-v1.json": in ../share/marsview next to the
/// installed program, or, for a program run from a build tree, in `resources` in one of the parent
/// folders. Empty if not found. `program_folder` is the folder of the executable.
std::filesystem::path bundledFileFor(const std::filesystem::path& program_folder,
                                     const std::filesystem::path& name);

/// The same for the running program.
std::filesystem::path bundledFile(const std::filesystem::path& name);

} // namespace marsview
