// Makes written data survive a power failure.
#pragma once

#include <cstdio>
#include <filesystem>

namespace marsview {

/// Flushes written data to the disk and waits for it. False on failure. On systems without such a
/// call, the data is only written.
bool flushToDisk(std::FILE* file);

/// Flushes a folder, so that the names of new files are on the disk too. Errors are ignored: some
/// file systems do not support it, and the content is safe in any case.
void flushFolderToDisk(const std::filesystem::path& folder);

} // namespace marsview
