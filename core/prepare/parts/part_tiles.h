// The encoded tiles that a part of a map has alone.
#pragma once

#include "core/base/result.h"
#include "core/prepare/parts/part_state.h"
#include "core/prepare/tiff/encoded_tiles.h"
#include "core/tiles/tile_source.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace marsview {

/// The pages that the tiled GeoTIFF of the map will have, in any order. Writes a small file in the
/// map's folder to see how GDAL lays out masks.
Result<std::vector<TiffPage>> pagesOfMap(const PartedMap& map, std::size_t part);

/// A file with nothing but the tiles of the part's rows, in the order of forEachTileRow(): its size
/// and the memory of the object do not depend on the size of the map. Reading is for any thread.
class PartTileFile final : public EncodedTiles {
public:
    static Result<std::unique_ptr<PartTileFile>> create(const PartedMap& map,
                                                        const PartRows& rows,
                                                        std::vector<TiffPage> pages,
                                                        const std::string& path);
    /// Opens a file to read. `sizes` and `checksums` are those of the tiles.
    static Result<std::unique_ptr<PartTileFile>> open(const PartedMap& map,
                                                      const PartRows& rows,
                                                      std::vector<TiffPage> pages,
                                                      const std::string& path,
                                                      std::span<const std::uint32_t> sizes,
                                                      std::span<const std::uint32_t> checksums);
    ~PartTileFile() override;

    const std::vector<TiffPage>& pages() const noexcept override { return pages_; }
    Status append(std::size_t page, std::size_t tile, std::span<const std::byte> encoded) override;
    Status flush() override;
    Result<std::vector<std::byte>> encoded(std::size_t page, std::size_t tile) const override;
    std::uint64_t encodedBytes(std::size_t page, std::size_t tile) const override;
    /// CRC-32 of an encoded tile.
    std::uint32_t checksum(std::size_t page, std::size_t tile) const;

    /// Of all tiles, in the order of forEachTileRow(), each row with its masks.
    std::vector<std::uint32_t> sizes() const;
    std::vector<std::uint32_t> checksums() const;
    /// Whether the tiles in the file have their checksums. Reads them all.
    bool isIntact() const;
    const std::string& path() const noexcept { return path_; }

private:
    struct Stored {
        std::uint64_t offset = 0;
        std::uint32_t bytes = 0;
        std::uint32_t checksum = 0;
    };
    struct PageTiles {
        std::size_t first = 0; // number of a tile
        std::vector<Stored> tiles;
    };

    PartTileFile(std::vector<TiffPage> pages, std::string path);
    Status begin(const PartedMap& map, const PartRows& rows, int flags);
    const Stored* find(std::size_t page, std::size_t tile) const;
    Error failed(const char* what) const;

    std::vector<TiffPage> pages_;
    std::string path_;
    int file_ = -1;
    std::uint64_t end_ = 0;
    std::vector<PageTiles> tiles_;                              // by page
    std::vector<std::pair<std::size_t, std::size_t>> in_order_; // page and tile
};

/// Opens the tiles of a part that has made the first pass.
Result<std::unique_ptr<PartTileFile>> openPartTiles(const PartedMap& map, std::size_t part);

/// Decodes the tiles of a part; others of the map's layout cannot be read. `file` outlives the
/// source. Any thread.
std::shared_ptr<const TileSource> sourceOf(const PartedMap& map, const PartTileFile& file);

} // namespace marsview
