// Rasters that are read from a server, piece by piece.
//
// GDAL does the transport; what is here makes it safe and says what went wrong. A raster is read
// over hours while somebody may put another in its place: every request carries the condition that
// the file is still the one that was opened, so that pieces of two never mix.
#pragma once

#include "core/base/result.h"
#include "core/files/gdal_runtime.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace marsview {

/// The name under which GDAL reads an address in pieces: "https://…" and "http://…" through
/// /vsicurl/, "s3://bucket/key" through /vsis3/, "gs://…" through /vsigs/; names that begin so are
/// their own. Nothing where `path` is none of these.
std::optional<std::string> remoteNameFor(const std::string& path);

/// What the user calls it: the inverse of remoteNameFor.
std::string addressOf(const std::string& remote_name);

/// What tells a file at a server from another in its place, as far as the server says.
struct RemoteVersion {
    std::uint64_t bytes = 0; // 0 where the server does not say
    std::string etag;        // as in the header, with its quotes
    std::string modified;    // an HTTP date
    bool operator==(const RemoteVersion&) const = default;

    /// Whether the server says more than how large it is.
    bool isNamed() const { return !etag.empty() || !modified.empty(); }
    /// One line for comparing and for keys.
    std::string text() const;
};

/// Asks the server, with one request. NotFound where there is nothing; Unreadable where the server
/// does not answer or refuses. What GDAL keeps of an earlier version is dropped. Any thread.
Result<RemoteVersion> askRemote(const std::string& remote_name);

/// While it lives, datasets that this thread opens are read on the condition that they are still
/// of `version`, and without looking for files beside them.
class RemoteScope {
public:
    RemoteScope(const std::string& remote_name, const RemoteVersion& version);
    ~RemoteScope();
    RemoteScope(const RemoteScope&) = delete;
    RemoteScope& operator=(const RemoteScope&) = delete;

private:
    struct Settings;
    std::unique_ptr<Settings> settings_;
};

/// While it lives, this thread fetches the blocks of a GeoTIFF's overviews as it does those of the
/// raster: their bytes and no more. GDAL 3.6 reads overviews in pieces of 16 KiB, ever more of them
/// at once, which was twice the bytes.
class ExactRanges {
public:
    ExactRanges();
    ~ExactRanges();
    ExactRanges(const ExactRanges&) = delete;
    ExactRanges& operator=(const ExactRanges&) = delete;

private:
    struct Settings;
    std::unique_ptr<Settings> settings_;
};

/// Why opening or reading failed, after asking the server once more: it is gone, has changed, does
/// not serve pieces, does not answer; `otherwise` where none of these is found. Drops what GDAL
/// keeps of the file, which may be cut short. The dataset must be closed and opened again: GDAL 3.6
/// returns other samples from one in which a read has failed.
Error remoteFailure(const std::string& remote_name,
                    const RemoteVersion& version,
                    const GdalMessages& messages,
                    const std::string& otherwise);

/// The refusal of a raster that is too large to be fetched whole and, for the reason `why`
/// ("it has no overviews"), cannot be fetched in pieces.
Error notCloudOptimised(const std::string& remote_name, const std::string& why);

} // namespace marsview
