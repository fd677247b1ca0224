// What the file system says of files, to notice when one is written to.
#pragma once

#include <string>
#include <vector>

namespace marsview {

/// The file on a disk: itself, or the archive where the name is one of GDAL's for something within
/// it ("/vsizip/maps/mars.zip/mars.tif"). Empty where there is none.
std::string fileHolding(const std::string& name);

/// Of each file: number, size and when content and entry were last changed, in nanoseconds. Files
/// that are not on a disk are left out.
std::string stampTextOf(const std::vector<std::string>& files);

} // namespace marsview
