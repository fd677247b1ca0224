// Finds the map that is installed with the program.
#pragma once

#include <filesystem>

namespace marsview {

/// The bundled map of Mars: in ../share/marsview/samples next to the installed program, or, for a
/// program run from a build tree, in resources/samples in one of the parent folders. Empty if not
/// found. `program_folder` is the folder of the executable.
std::filesystem::path sampleMapFor(const std::filesystem::path& program_folder);

} // namespace marsview
