#include "core/prepare/tile_row_writer.h"

#include "core/base/parallel.h"
#include "core/prepare/tiff/tiff_tiles.h"
#include "core/prepare/tiff/tile_encoding.h"
#include "core/tiles/tile.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <utility>

namespace marsview {
namespace {

// Copies the part of a tile within the grid and repeats the last column and row beyond.
std::vector<std::byte> tileBytes(const std::byte* rows,
                                 std::size_t columns,
                                 std::size_t row_count,
                                 std::size_t tile_column,
                                 std::size_t sample_bytes)
{
    const std::size_t width = std::min(kTileSide, columns - tile_column * kTileSide);
    const std::size_t row_bytes = kTileSide * sample_bytes;
    std::vector<std::byte> tile(kTileSide * row_bytes);
    for (std::size_t y = 0; y < kTileSide; ++y) {
        std::byte* const to = tile.data() + y * row_bytes;
        if (y >= row_count) {
            std::memcpy(to, to - row_bytes, row_bytes);
            continue;
        }
        std::memcpy(to, rows + (y * columns + tile_column * kTileSide) * sample_bytes,
                    width * sample_bytes);
        for (std::size_t x = width; x < kTileSide; ++x) {
            std::memcpy(to + x * sample_bytes, to + (width - 1) * sample_bytes, sample_bytes);
        }
    }
    return tile;
}

// A mask's tile in the file's format: one bit or byte per sample, all ones if valid.
template <typename IsValid>
std::vector<std::byte>
maskBytes(const TiffPage& page, std::size_t width, std::size_t height, IsValid&& is_valid)
{
    std::vector<std::byte> tile(kTileSide * (page.has_bits ? kTileSide / 8 : kTileSide));
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            if (!is_valid(x, y)) {
                continue;
            }
            if (page.has_bits) {
                tile[(y * kTileSide + x) / 8] |= std::byte{0x80} >> (x % 8);
            } else {
                tile[y * kTileSide + x] = std::byte{0xFF};
            }
        }
    }
    return tile;
}

std::vector<std::byte> encodeMask(const TiffPage& page, std::vector<std::byte> tile)
{
    return encodeTile(tile, page.has_bits ? kTileSide / 8 : kTileSide, 1, page.predictor);
}

} // namespace

TileRowWriter::TileRowWriter(std::unique_ptr<EncodedTiles> tiles,
                             const RasterInfo& info,
                             std::string path,
                             const RowMemory& memory)
    : tiles_(std::move(tiles))
    , path_(std::move(path))
    , columns_(info.columns)
    , rows_(info.rows)
    , type_(info.type)
    , tiles_at_once_(memory.tilesAtOnce(info.type))
{
    const std::size_t levels = overviewCount(columns_, rows_) + 1;
    constexpr std::size_t kNone = ~std::size_t{0};
    pages_.assign(levels, kNone);
    mask_pages_.assign(info.needsVoidMask() ? levels : 0, kNone);
}

Result<TileRowWriter>
TileRowWriter::open(const std::string& path, const RasterInfo& info, const RowMemory& memory)
{
    Result<TiffTiles> tiles = TiffTiles::open(path);
    if (!tiles) {
        return std::move(tiles).error();
    }
    return to(std::make_unique<TiffTiles>(std::move(tiles).value()), info, path, memory);
}

Result<TileRowWriter> TileRowWriter::to(std::unique_ptr<EncodedTiles> tiles,
                                        const RasterInfo& info,
                                        const std::string& path,
                                        const RowMemory& memory)
{
    TileRowWriter writer(std::move(tiles), info, path, memory);
    if (!writer.findPages()) {
        return writeError(path, 0, "was not created with the requested layout");
    }
    return writer;
}

// Finds the page of every level by its size.
bool TileRowWriter::findPages()
{
    const std::vector<TiffPage>& pages = tiles_->pages();
    for (std::size_t i = 0; i < pages.size(); ++i) {
        for (std::size_t level = 0; level < pages_.size(); ++level) {
            if (pages[i].columns == TileLayout::samplesAlong(TileKind::Means, level, columns_) &&
                pages[i].rows == TileLayout::samplesAlong(TileKind::Means, level, rows_)) {
                std::vector<std::size_t>& of = pages[i].is_mask ? mask_pages_ : pages_;
                if (level < of.size()) {
                    of[level] = i;
                }
            }
        }
    }
    const auto is_found = [&pages](std::size_t page) { return page < pages.size(); };
    return pages.size() == pages_.size() + mask_pages_.size() &&
           std::all_of(pages_.begin(), pages_.end(), is_found) &&
           std::all_of(mask_pages_.begin(), mask_pages_.end(), is_found);
}

// `encode` makes a tile from its column. `release` is called between steps.
template <typename Encode, typename Release>
Status
TileRowWriter::appendRow(std::size_t page, std::size_t tile_row, Encode&& encode, Release&& release)
{
    const std::size_t count = tiles_->pages()[page].tile_columns;
    for (std::size_t first = 0; first < count; first += tiles_at_once_) {
        std::vector<std::vector<std::byte>> tiles(std::min(tiles_at_once_, count - first));
        parallelRanges(tiles.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                tiles[i] = encode(first + i);
            }
        });
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            if (tiles[i].empty()) {
                return Error{ErrorCode::TooLarge,
                             fmt::format("{}: not enough memory to compress its tiles", path_)};
            }
            if (Status written = tiles_->append(page, tile_row * count + first + i, tiles[i]);
                !written) {
                return written;
            }
        }
        release();
    }
    return Done{};
}

Status TileRowWriter::copyRow(const SampleGrid& grid,
                              std::size_t grid_row,
                              std::size_t tile_row,
                              OverviewBuilder& overviews)
{
    const std::size_t height = std::min(kTileSide, rows_ - tile_row * kTileSide);
    const std::size_t sample_bytes = sampleBytes(type_);
    const TiffPage& page = tiles_->pages()[pages_[0]];
    const std::byte* const rows = grid.visit([&](auto samples) {
        return reinterpret_cast<const std::byte*>(samples.row(grid_row).data());
    });
    const auto release = [&] {
        grid.releasePages();
        overviews.release();
    };
    Status written = appendRow(
        pages_[0], tile_row,
        [&](std::size_t column) {
            std::vector<std::byte> tile = tileBytes(rows, columns_, height, column, sample_bytes);
            overviews.addTile(grid, grid_row, column, tile_row);
            return encodeTile(tile, kTileSide, sample_bytes, page.predictor);
        },
        release);
    if (!written || !hasMasks()) {
        return written;
    }
    const TiffPage& mask_page = tiles_->pages()[mask_pages_[0]];
    const auto encode_mask = [&](std::size_t column) {
        const std::size_t first = column * kTileSide;
        const auto is_valid = [&](std::size_t x, std::size_t y) {
            return !grid.isVoid(first + x, grid_row + y);
        };
        return encodeMask(mask_page, maskBytes(mask_page, std::min(kTileSide, columns_ - first),
                                               height, is_valid));
    };
    return appendRow(mask_pages_[0], tile_row, encode_mask, release);
}

Status TileRowWriter::writeLevelRow(std::size_t level,
                                    const OverviewBuilder::Rows& rows,
                                    std::size_t tile_row)
{
    const std::size_t sample_bytes = sampleBytes(type_);
    const TiffPage& page = tiles_->pages()[pages_[level]];
    const auto release = [&] { rows.release(); };
    Status written = appendRow(
        pages_[level], tile_row,
        [&](std::size_t column) {
            std::vector<std::byte> tile =
                tileBytes(rows.samples, rows.columns, rows.rows, column, sample_bytes);
            return encodeTile(tile, kTileSide, sample_bytes, page.predictor);
        },
        release);
    if (!written || !hasMasks()) {
        return written;
    }
    const TiffPage& mask_page = tiles_->pages()[mask_pages_[level]];
    const auto encode_mask = [&](std::size_t column) {
        const std::size_t first = column * kTileSide;
        const auto is_valid = [&](std::size_t x, std::size_t y) {
            return rows.valid[y * rows.columns + first + x] != 0;
        };
        return encodeMask(mask_page, maskBytes(mask_page, std::min(kTileSide, rows.columns - first),
                                               rows.rows, is_valid));
    };
    return appendRow(mask_pages_[level], tile_row, encode_mask, release);
}

Status TileRowWriter::writeLevel(std::size_t level, const OverviewBuilder::Rows& all)
{
    for (std::size_t first = 0; first < all.rows; first += kTileSide) {
        OverviewBuilder::Rows rows = all;
        rows.samples += first * all.columns * sampleBytes(type_);
        rows.valid += all.valid != nullptr ? first * all.columns : 0;
        rows.rows = std::min(kTileSide, all.rows - first);
        if (Status written = writeLevelRow(level, rows, first / kTileSide); !written) {
            return written;
        }
    }
    return Done{};
}

} // namespace marsview
