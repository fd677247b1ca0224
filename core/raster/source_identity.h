// Telling whether a file is still the one that something was made from.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <string>

namespace marsview {

/// What tells one raster file, or address, from another and from itself after a change.
struct SourceIdentity {
    std::string path;            // absolute; an address as it is
    std::uint64_t bytes = 0;     // of all files that belong to it: a label's data, a mosaic's parts
    std::int64_t modified_s = 0; // since 1970, of the latest
    std::string digest;          // of some of the content, spread over all of it: hexadecimal
    bool operator==(const SourceIdentity&) const = default;
};

/// Whether there is a file of that name, which may be one of GDAL's ("/vsicurl/…"): one request.
bool fileExists(const std::string& path);

/// Whether overviews beside the raster (.ovr) are a part of what it is: of no copy of its samples,
/// but of what is read in place.
enum class OverviewFiles : std::uint8_t { Ignored, Counted };

/// Reads a few dozen kilobytes of each file that belongs to the raster. Statistics that other
/// programs leave beside it (.aux.xml) do not count. NotFound or Unreadable where there is nothing
/// to read. Names with a scheme are asked of GDAL's file systems. Any thread.
Result<SourceIdentity> identify(const std::string& path,
                                OverviewFiles overviews = OverviewFiles::Ignored);

/// Whether `now` is what `then` was. The path does not count: a file may move together with what
/// was made from it; nor does the time where `now` is an address.
bool isSameContent(const SourceIdentity& then, const SourceIdentity& now);

} // namespace marsview
