// Detects writes to a raster's files during reading.
#pragma once

#include <string>
#include <vector>

namespace marsview {

/// File-system metadata of a raster's files: finer than SourceIdentity, which must survive a move
/// to another disk, but valid only on this disk.
struct SourceStamp {
    std::vector<std::string> files;
    /// For each file: inode number, size and the times of the last change of content and inode, in
    /// nanoseconds. Equal if none of them was written to, to the time resolution of the file system
    /// (usually a few milliseconds). Empty if the raster is not on a disk.
    std::string text;
};

/// Take it before the first byte is read. Reads no samples. Any thread.
SourceStamp stampOf(const std::string& path);

/// Whether the same files are unchanged since then.
bool isUntouched(const SourceStamp& then);

} // namespace marsview
