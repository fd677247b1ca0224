// Rasters that are read from a server by range requests.
//
// GDAL does the transport; this module makes it safe and explains failures. A raster may be
// replaced on the server during hours of reading. Every request therefore carries the condition
// that the file is still the opened version, so that parts of two versions never mix.
#pragma once

#include "core/base/result.h"
#include "core/files/gdal_runtime.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace marsview {

/// The name under which GDAL reads an address in pieces: "https://…" and "http://…" through
/// /vsicurl/, "s3://bucket/key" through /vsis3/, "gs://…" through /vsigs/; names with these
/// prefixes are returned unchanged. Empty if `path` is none of these.
std::optional<std::string> remoteNameFor(const std::string& path);

/// The user's address: the inverse of remoteNameFor.
std::string addressOf(const std::string& remote_name);

/// The version of a file on a server, as far as the server reports it.
struct RemoteVersion {
    std::uint64_t bytes = 0; // 0 if the server does not report it
    std::string etag;        // as in the header, with its quotes
    std::string modified;    // an HTTP date
    bool operator==(const RemoteVersion&) const = default;

    /// Whether the server reports more than the size.
    bool isNamed() const { return !etag.empty() || !modified.empty(); }
    /// One line for comparing and for keys.
    std::string text() const;
};

/// Asks the server, with one request. NotFound if the file does not exist; Unreadable if the server
/// does not respond or refuses. Drops GDAL's cached data of an earlier version. Any thread.
Result<RemoteVersion> askRemote(const std::string& remote_name);

/// During its lifetime, datasets opened on this thread are read on the condition that their version
/// is still `version`, and without searching for companion files.
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

/// During its lifetime, this thread fetches the blocks of a GeoTIFF's overviews like those of the
/// raster: exactly their bytes. GDAL 3.6 reads overviews in growing runs of 16 KiB chunks, which
/// took twice the bytes.
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

/// A part of the message about a truncated response.
inline constexpr std::string_view kConnectionLost = "the connection was lost";

/// Why opening or reading failed, after asking the server once more: the file is gone or has
/// changed, or the server does not support ranges or does not respond; `otherwise` if none of these
/// is found. Drops GDAL's cached data of the file, which may be truncated. The dataset must be
/// closed and reopened: after a failed read GDAL 3.6 returns wrong samples from it.
Error remoteFailure(const std::string& remote_name,
                    const RemoteVersion& version,
                    const GdalMessages& messages,
                    const std::string& otherwise);

/// The error for a raster that is too large to download whole and, for the reason `why` ("it has no
/// overviews"), cannot be read by ranges.
Error notCloudOptimised(const std::string& remote_name, const std::string& why);

} // namespace marsview
