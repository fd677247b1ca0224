// Checks that an ASCII grid has as many numbers as its header declares.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace marsview {

/// Whether GDAL's driver of that name reads ESRI or GRASS ASCII grids.
bool isTextGrid(std::string_view driver);

/// For ESRI and GRASS ASCII grids: Unreadable, a sentence without the path, if fewer than `count`
/// words follow the header. `path` may be one of GDAL's, such as a file in an archive. A zero byte
/// ends the words, as in GDAL. Reads the file, a gigabyte in a second or two; the result is cached
/// until the file changes. Any thread.
Status checkTextGrid(const std::string& path, std::uint64_t count);

} // namespace marsview
