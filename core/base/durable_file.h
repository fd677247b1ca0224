// Makes written data survive a power failure.
#pragma once

#include "core/base/result.h"

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace marsview {

/// Flushes written data to the disk and waits for it. False on failure. On systems without such a
/// call, the data is only written.
bool flushToDisk(std::FILE* file);

/// Flushes a folder, so that the names of new files are on the disk too. Errors are ignored: some
/// file systems do not support it, and the content is safe in any case.
void flushFolderToDisk(const std::filesystem::path& folder);

/// Replaces the content of a file, or creates it. At every moment, also after a crash or a power
/// failure, the file has either the old content or the new one. The permissions of an existing file
/// stay; a link is followed. The new content is first written to a hidden file next to it, which
/// a crash may leave behind. Errors begin with the path. Blocks on the disk.
Status replaceFile(const std::filesystem::path& path, std::string_view content);

} // namespace marsview
