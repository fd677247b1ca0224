// File-system metadata of files, to detect writes.
#pragma once

#include <string>
#include <vector>

namespace marsview {

/// The file on a disk: itself, or the archive if the name is a GDAL name for one of its members
/// ("/vsizip/maps/mars.zip/mars.tif"). Empty if there is none.
std::string fileHolding(const std::string& name);

/// For each file: inode number, size and the times of the last change of content and inode, in
/// nanoseconds. Files that are not on a disk are skipped.
std::string stampTextOf(const std::vector<std::string>& files);

} // namespace marsview
