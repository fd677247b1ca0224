// The checkpoint of an unfinished tiled GeoTIFF.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// The guaranteed content of the unfinished file.
struct CopyCheckpoint {
    std::string key;             // source, settings and format: identifies the job
    std::string source_stamp;    // SourceStamp::text of the source
    std::uint64_t tile_rows = 0; // of the raster, complete
    std::uint64_t tile_rows_all = 0;
    std::uint64_t file_bytes = 0;
    std::vector<std::uint8_t> overviews; // OverviewBuilder::save

    bool operator==(const CopyCheckpoint&) const = default;
};

/// Replaces the checkpoint atomically; it is on the disk when the function returns. False if it
/// could not be written; the previous one is then unchanged.
bool saveCheckpoint(const std::string& path, const CopyCheckpoint& checkpoint);

/// Empty if there is none, or if it is damaged or of another version.
std::optional<CopyCheckpoint> readCopyCheckpoint(const std::string& path);

} // namespace marsview
