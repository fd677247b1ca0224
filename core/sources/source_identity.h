// Identifies the source that a prepared file was made from.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <string>

namespace marsview {

/// Identifies a raster file or address and its version.
struct SourceIdentity {
    std::string path;            // absolute; an address unchanged
    std::uint64_t bytes = 0;     // of all its files: a label's data, a mosaic's parts
    std::int64_t modified_s = 0; // since 1970, of the latest
    std::string digest;          // hexadecimal, of samples spread over the whole content
    bool operator==(const SourceIdentity&) const = default;
};

/// Whether there is a file of that name, which may be one of GDAL's ("/vsicurl/…"): one request.
bool fileExists(const std::string& path);

/// Whether overviews next to the raster (.ovr) count as part of it: not for a copy of its samples,
/// but for a raster that is read in place.
enum class OverviewFiles : std::uint8_t { Ignored, Counted };

/// Reads a few dozen kilobytes of each file of the raster. Statistics that other programs leave
/// next to it (.aux.xml) are excluded. NotFound or Unreadable if there is nothing to read. Names
/// with a scheme are read through GDAL's file systems. Any thread.
Result<SourceIdentity> identify(const std::string& path,
                                OverviewFiles overviews = OverviewFiles::Ignored);

/// Whether `now` has the same content as `then`. The path is ignored, because a file may move
/// together with its prepared form; so is the time if `now` is an address.
bool isSameContent(const SourceIdentity& then, const SourceIdentity& now);

} // namespace marsview
