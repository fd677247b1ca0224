// Checks that a TIFF is as long as its header requires, without and before using a library.
#pragma once

#include "core/base/result.h"

#include <optional>
#include <string>

namespace marsview {

struct TiffSizes {
    /// Done, or why the file is too short for its first directories: Unreadable, a sentence without
    /// the path. Uses rules that every valid file satisfies: lists and blocks end within the file,
    /// every block has an entry in the lists, and no block expands by more than its compression
    /// allows.
    Status fits = Done{};
    /// Whether GDAL decodes the blocks with its own code or general compression libraries, not with
    /// libraries of picture formats.
    bool is_plain = true;
};

/// Empty if the file on disk is not a TIFF. Memory: one list of blocks, at most the size of the
/// file. Any thread.
std::optional<TiffSizes> tiffSizesOf(const std::string& path);

} // namespace marsview
