// Writes the tiles of a GeoTIFF whose directories already exist.
#pragma once

#include "core/base/result.h"
#include "core/prepare/tiff/tile_encoding.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace marsview {

/// One picture in the file: the raster or one of its overviews, or the mask of one.
struct TiffPage {
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::size_t tile_columns = 0; // tiles along a row, of kTileSide samples
    std::size_t tile_rows = 0;
    bool is_mask = false;  // one bit per sample
    bool has_bits = false; // mask samples are packed, eight to a byte
    TiffPredictor predictor = TiffPredictor::None;
};

/// A tiled, deflated BigTIFF that GDAL created without tiles. Tiles are appended; their offsets
/// stay in memory until flush(), which overwrites only the directories' arrays in place. If the
/// program is killed, the file opens and has at least all tiles of the last flush. For one thread
/// at a time.
class TiffTiles {
public:
    enum class Access : std::uint8_t { Read, Write };
    static Result<TiffTiles> open(const std::string& path, Access access = Access::Write);
    TiffTiles(TiffTiles&&) noexcept;
    TiffTiles& operator=(TiffTiles&&) noexcept;
    ~TiffTiles();

    /// In the file's order.
    const std::vector<TiffPage>& pages() const noexcept;

    /// Appends an encoded tile. Errors name the file and report a full disk as such.
    Status append(std::size_t page, std::size_t tile, std::span<const std::byte> encoded);

    /// On success all appended tiles are in the file and the file is on the disk.
    Status flush();

    /// The size of the file in bytes.
    Result<std::uint64_t> fileBytes() const;

    /// The encoded tile as it is in the file. Invalid if it is missing.
    Result<std::vector<std::byte>> encoded(std::size_t page, std::size_t tile) const;

    /// The number of bytes of an encoded tile; 0 if it is missing.
    std::uint64_t encodedBytes(std::size_t page, std::size_t tile) const;

    /// The position of an encoded tile; 0 if it is missing.
    std::uint64_t offsetOf(std::size_t page, std::size_t tile) const;

    /// Whether the first `tiles` tiles of a page exist and end within `file_bytes`.
    bool holdsTiles(std::size_t page, std::size_t tiles, std::uint64_t file_bytes) const;

    /// Whether these tiles, which holdsTiles() has found, are intact, by the checksum of each.
    /// Reads and inflates them all, on all cores: some 300 MB/s per core.
    bool areWhole(std::size_t page, std::size_t tiles) const;

    /// Truncates or extends the file to `file_bytes`, or to the end of the last block in its
    /// directories if that is larger.
    Status trim(std::uint64_t file_bytes);

private:
    struct Impl;
    explicit TiffTiles(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// The message for a system error while writing `path`, as one sentence.
Error writeError(const std::string& path, int system_error, const std::string& otherwise);

} // namespace marsview
