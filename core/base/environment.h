// What the environment says about where things are.
#pragma once

#include <filesystem>
#include <string>

namespace marsview {

/// Empty where it is not set. Any thread, as long as none changes the environment.
std::string environmentVariable(const char* name);

/// One of the user's folders of the XDG base directory specification: what the variable says where
/// that is an absolute path, else `below_home` in the home folder.
std::filesystem::path userFolder(const char* variable, const char* below_home);

} // namespace marsview
