// Pictures and the files they are saved in.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace marsview {

/// Width × height pixels of red, green and blue, row by row from the top.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
};

/// Writes a PNG file, and replaces an existing file only when the new one is complete. Unreadable
/// if it cannot be written.
Status writePng(const Picture& picture, const std::string& path);
/// The same as a TIFF file, with lossless compression.
Status writeTiff(const Picture& picture, const std::string& path);

} // namespace marsview
