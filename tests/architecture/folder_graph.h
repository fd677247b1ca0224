// Which folders include each other, and how many files they hold.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

namespace marsview::test {

/// An #include line: both paths are relative to the source root.
struct Include {
    std::string file;
    std::string header;
    bool operator==(const Include&) const = default;
};

/// The folder that a path lies in, without a slash at its end. A folder and a folder within it are
/// two: "ui" does not contain "ui/overlay/legend.h".
std::string folderOf(const std::string& path);

/// One cycle of folders: every folder includes the next one, and the last one the first.
struct FolderCycle {
    std::vector<std::string> folders;
    std::vector<Include> includes; // all that lead from each of them to the next
};

/// A shortest cycle of every group of folders that reach each other. Empty where folders can be
/// ordered so that all includes point down.
std::vector<FolderCycle> folderCycles(std::span<const Include> includes);

/// The folders that hold more than `files_max` files themselves, with their number of files.
std::map<std::string, std::size_t> crowdedFolders(std::span<const std::string> paths,
                                                  std::size_t files_max);

} // namespace marsview::test
