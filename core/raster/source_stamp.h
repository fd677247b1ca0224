// Telling whether somebody wrote to a raster's files while they were read.
#pragma once

#include <string>
#include <vector>

namespace marsview {

/// What the file system says of a raster's files: finer than SourceIdentity, which has to stand a
/// move to another disk, and of no meaning there.
struct SourceStamp {
    std::vector<std::string> files;
    /// Of each: number, size and when content and entry were last changed, in nanoseconds. Equal
    /// where nobody wrote to any of them, as finely as the file system keeps time (mostly a few
    /// milliseconds). Empty where the raster lies on no disk.
    std::string text;
};

/// To be taken before the first byte is read. Reads no samples. Any thread.
SourceStamp stampOf(const std::string& path);

/// Whether the same files still are as they were then.
bool isUntouched(const SourceStamp& then);

} // namespace marsview
