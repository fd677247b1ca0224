// Writing the tiles of a GeoTIFF whose directories are already there.
#pragma once

#include "core/base/result.h"
#include "core/prepare/tile_encoding.h"

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
    bool is_mask = false;  // one bit a sample
    bool has_bits = false; // mask samples are packed, eight to a byte
    TiffPredictor predictor = TiffPredictor::None;
};

/// A tiled, deflated BigTIFF that was laid out by GDAL without any tile in it. Tiles are appended;
/// where they lie is kept in memory until flush(), which overwrites the directories' arrays in
/// place and nothing else: a program that is killed leaves a file that opens and holds at least
/// all tiles of the last flush. For one thread at a time.
class TiffTiles {
public:
    enum class Access : std::uint8_t { Read, Write };
    static Result<TiffTiles> open(const std::string& path, Access access = Access::Write);
    TiffTiles(TiffTiles&&) noexcept;
    TiffTiles& operator=(TiffTiles&&) noexcept;
    ~TiffTiles();

    /// In the file's order.
    const std::vector<TiffPage>& pages() const noexcept;

    /// An encoded tile. Errors name the file; a full disk is said to be one.
    Status append(std::size_t page, std::size_t tile, std::span<const std::byte> encoded);

    /// On success all that was appended is in the file and the file on the disk.
    Status flush();

    /// Bytes of the file.
    Result<std::uint64_t> fileBytes() const;

    /// Whether the first `tiles` tiles of a page are there and end within `file_bytes`.
    bool holdsTiles(std::size_t page, std::size_t tiles, std::uint64_t file_bytes) const;

    /// Whether these tiles, which holdsTiles() has found, are what was appended, by the checksum
    /// that each carries. Reads and inflates them all, on all cores: some 300 MB/s each.
    bool areWhole(std::size_t page, std::size_t tiles) const;

    /// Gives the file a size of at least `file_bytes` and of all that its directories point to,
    /// and cuts off what lies beyond.
    Status trim(std::uint64_t file_bytes);

private:
    struct Impl;
    explicit TiffTiles(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// What an error of the system means when `path` is written, as one sentence.
Error writeError(const std::string& path, int system_error, const std::string& otherwise);

} // namespace marsview
