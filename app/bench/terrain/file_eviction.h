// Removes files from the system's page cache, for measurements with cold data.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace marsview {

struct EvictedFiles {
    std::size_t file_count = 0;
    double bytes = 0.0;
    double resident_share = 0.0; // the fraction that is still cached
};

/// Asks the system to drop files, and all files below folders, from its cache. It may decline.
EvictedFiles evict(const std::vector<std::filesystem::path>& paths);

} // namespace marsview
