// Whether a TIFF can hold what its header promises, found without a library and before any reads
// it.
#pragma once

#include "core/base/result.h"

#include <optional>
#include <string>

namespace marsview {

struct TiffPromise {
    /// Done, or why the file cannot hold what its first directories say: Unreadable, a sentence
    /// without the path. Judged by what no valid file breaks: lists and blocks end within the file,
    /// every block has an entry in the lists, and no block grows by more than its compression can.
    Status fits = Done{};
    /// Whether its blocks are stored in ways that GDAL decodes with code of its own or with general
    /// compression libraries, not with those of picture formats.
    bool is_plain = true;
};

/// Nothing where the file on disk is not a TIFF. Takes memory for one list of blocks, and only as
/// much as the file has. Any thread.
std::optional<TiffPromise> tiffPromiseOf(const std::string& path);

} // namespace marsview
