// Where files are that come with the program.
#pragma once

#include <filesystem>

namespace marsview {

/// `name` ("devices/polhem-v1.json") in what came with the program: beside the installed program
/// (../share/marsview), or, for a program that runs from a build tree, in `resources` of a folder
/// above it. Empty where there is none. `program_folder` is where the executable lies.
std::filesystem::path bundledFileFor(const std::filesystem::path& program_folder,
                                     const std::filesystem::path& name);

/// Of this program.
std::filesystem::path bundledFile(const std::filesystem::path& name);

} // namespace marsview
