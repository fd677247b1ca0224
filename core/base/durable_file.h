// Seeing to it that what was written outlives a power cut.
#pragma once

#include <cstdio>
#include <filesystem>

namespace marsview {

/// Has the system put all that was written on the disk, and waits for it. False where it could not.
/// Where the system has no such thing it only writes.
bool flushToDisk(std::FILE* file);

/// The name of a file is on the disk when its folder is. Some file systems cannot tell; content is
/// safe in any case.
void flushFolderToDisk(const std::filesystem::path& folder);

} // namespace marsview
