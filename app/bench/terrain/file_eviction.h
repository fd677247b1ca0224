// Taking files out of the system's memory, for measuring from cold.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace marsview {

struct EvictedFiles {
    std::size_t file_count = 0;
    double bytes = 0.0;
    double resident_share = 0.0; // what the system kept all the same
};

/// Asks the system to forget the content of files and of all files below folders. It may decline.
EvictedFiles evict(const std::vector<std::filesystem::path>& paths);

} // namespace marsview
