// Environment variables and user folders.
#pragma once

#include <filesystem>
#include <string>

namespace marsview {

/// Empty if it is not set. Any thread, as long as no thread changes the environment.
std::string environmentVariable(const char* name);

/// One of the user's folders of the XDG base directory specification: the value of the variable if
/// it is an absolute path, otherwise `below_home` in the home folder.
std::filesystem::path userFolder(const char* variable, const char* below_home);

} // namespace marsview
