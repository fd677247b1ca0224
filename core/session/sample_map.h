// Where the map is that comes with the program.
#pragma once

#include <filesystem>

namespace marsview {

/// The bundled Mars: beside the installed program (../share/marsview/samples), or, for a program
/// that runs from a build tree, in resources/samples of a folder above it. Empty where there is
/// none. `program_folder` is where the executable lies.
std::filesystem::path sampleMapFor(const std::filesystem::path& program_folder);

} // namespace marsview
