// A file of encoded tiles of a map and its overviews.
#pragma once

#include "core/base/result.h"
#include "core/prepare/tiff/tile_encoding.h"

#include <cstddef>
#include <cstdint>
#include <span>
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

/// Tiles by page and number. Writing is for one thread at a time.
class EncodedTiles {
public:
    virtual ~EncodedTiles() = default;
    EncodedTiles(const EncodedTiles&) = delete;
    EncodedTiles& operator=(const EncodedTiles&) = delete;

    virtual const std::vector<TiffPage>& pages() const noexcept = 0;
    /// Appends an encoded tile. Errors name the file and report a full disk as such.
    virtual Status
    append(std::size_t page, std::size_t tile, std::span<const std::byte> encoded) = 0;
    /// On success all appended tiles are in the file and the file is on the disk.
    virtual Status flush() = 0;
    /// The encoded tile as it is in the file. Invalid if it is missing.
    virtual Result<std::vector<std::byte>> encoded(std::size_t page, std::size_t tile) const = 0;
    /// The number of bytes of an encoded tile; 0 if it is missing.
    virtual std::uint64_t encodedBytes(std::size_t page, std::size_t tile) const = 0;

protected:
    EncodedTiles() = default;
    EncodedTiles(EncodedTiles&&) = default;
    EncodedTiles& operator=(EncodedTiles&&) = default;
};

} // namespace marsview
