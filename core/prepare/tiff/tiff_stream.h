// Writes a tiled GeoTIFF from front to back, from tiles that are encoded already.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/prepare/tiff/tiff_tiles.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace marsview {

/// Bytes that go to a file in order, without seeking: the file may be an object on a server. For
/// one thread.
class ByteStream {
public:
    virtual ~ByteStream() = default;
    ByteStream(const ByteStream&) = delete;
    ByteStream& operator=(const ByteStream&) = delete;

    /// Errors name the file and report a full disk as such.
    virtual Status write(std::span<const std::byte> bytes) = 0;
    /// Call once, at the end: on success, all bytes are safe.
    virtual Status finish() = 0;

    /// A file on a disk, or, for a name of remoteNameFor(), an object on a server, which appears
    /// when it is finished.
    static Result<std::unique_ptr<ByteStream>> open(const std::string& path);

protected:
    ByteStream() = default;
};

/// A tile of the file to write, from a tile of the same page and number of another file.
struct StreamedTile {
    std::uint32_t file = 0; // index in the list of files
    std::uint32_t page = 0;
    std::uint64_t tile = 0;
    std::uint32_t checksum = 0; // CRC-32 of the encoded tile
    bool is_checked = false;    // against `checksum`
};

struct TiffStreamJob {
    /// A file without tiles, whose directories become those of the new file.
    std::string skeleton;
    std::uint64_t skeleton_bytes = 0;       // before its first tile; 0: all bytes
    std::vector<const EncodedTiles*> files; // with the same pages
    std::vector<StreamedTile> tiles;        // all tiles, in the order of the new file
    std::vector<std::string> names;         // of the files, for messages
    std::vector<std::string> remedies;      // what to do if a file is damaged; as many, or none
};

/// Writes the skeleton, with its directories filled, and then the tiles. Memory: 16 bytes for each
/// tile and the skeleton. Errors: those of the files, a tile that does not match its checksum
/// (Damaged), Canceled.
Status streamTiff(const TiffStreamJob& job, ByteStream& to, JobMonitor& monitor);

} // namespace marsview
