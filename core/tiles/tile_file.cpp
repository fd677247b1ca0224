// Layout of a file, numbers in the machine's byte order (files stay on the machine that wrote them,
// and the magic number differs in the other byte order):
//
//   header, the key's text, then compressed with zlib: samples, void bits, fills
//
// Samples are stored as differences from the sample to their left, as integers of their size:
// terrain then compresses to about half the size.

#include "core/tiles/tile_file.h"

#include "core/base/deflate.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

namespace marsview {
namespace {

constexpr std::uint64_t kMagic = 0x31'45'4C'49'54'56'4D'00ULL; // "\0MVTILE1"

struct Header {
    std::uint64_t magic = kMagic;
    std::uint32_t checksum = 0; // CRC-32 of all that follows
    std::uint32_t key_bytes = 0;
    std::uint32_t column = 0;
    std::uint32_t row = 0;
    std::uint16_t width = 0;
    std::uint16_t height = 0;
    std::uint8_t kind = 0;
    std::uint8_t level = 0;
    std::uint8_t type = 0;
    std::uint8_t parts = 0; // kHasVoids, kHasFills
};
static_assert(std::has_unique_object_representations_v<Header>, "no padding to leave undefined");

constexpr std::size_t kChecksumEnd = offsetof(Header, checksum) + sizeof(Header::checksum);
// The fastest: others cost several times as much and save a tenth.
constexpr int kEffort = 1;
constexpr std::uint8_t kHasVoids = 1;
constexpr std::uint8_t kHasFills = 2;

std::uint32_t checksumOf(std::span<const std::byte> file)
{
    return crc32Of(file.subspan(kChecksumEnd));
}

enum class Differences { Take, Undo };

void difference(std::byte* row, std::size_t count, SampleType type, Differences which)
{
    dispatchUnsigned(sampleBytes(type), [&](auto zero) {
        using T = decltype(zero);
        T before = 0;
        for (std::size_t i = 0; i < count; ++i) {
            T value{};
            std::memcpy(&value, row + i * sizeof(T), sizeof(T));
            const T changed = which == Differences::Take ? static_cast<T>(value - before)
                                                         : static_cast<T>(value + before);
            before = which == Differences::Take ? value : changed;
            std::memcpy(row + i * sizeof(T), &changed, sizeof(T));
        }
    });
}

struct Sizes {
    std::size_t row = 0;
    std::size_t samples = 0;
    std::size_t voids = 0;
    std::size_t fills = 0;
    std::size_t all() const { return samples + voids + fills; }
};

Sizes sizesOf(const Header& header, SampleType type)
{
    const std::size_t count = std::size_t{header.width} * header.height;
    return {.row = header.width * sampleBytes(type),
            .samples = count * sampleBytes(type),
            .voids = (header.parts & kHasVoids) != 0 ? (count + 7) / 8 : 0,
            .fills = (header.parts & kHasFills) != 0 ? count * sizeof(float) : 0};
}

std::vector<std::byte> plainParts(const Tile& tile, const Header& header, const Sizes& sizes)
{
    const SampleGrid& grid = tile.samples;
    std::vector<std::byte> plain(sizes.all());
    grid.visit([&](auto view) {
        for (std::size_t row = 0; row < header.height; ++row) {
            std::byte* to = plain.data() + row * sizes.row;
            std::memcpy(to, view.row(row).data(), sizes.row);
            difference(to, header.width, grid.type(), Differences::Take);
        }
    });
    for (std::size_t i = 0; sizes.voids > 0 && i < std::size_t{header.width} * header.height; ++i) {
        if (grid.isVoid(i % header.width, i / header.width)) {
            plain[sizes.samples + i / 8] |= std::byte{1} << (i % 8);
        }
    }
    if (sizes.fills > 0) {
        std::memcpy(plain.data() + sizes.samples + sizes.voids, tile.filled_m.data(), sizes.fills);
    }
    return plain;
}

std::optional<Tile> tileFrom(std::vector<std::byte>& plain,
                             const TileId& id,
                             const Header& header,
                             SampleType type,
                             const Sizes& sizes)
{
    Result<SampleGrid> grid = SampleGrid::create(type, header.width, header.height);
    if (!grid) {
        return std::nullopt;
    }
    for (std::size_t row = 0; row < header.height; ++row) {
        std::byte* from = plain.data() + row * sizes.row;
        difference(from, header.width, type, Differences::Undo);
        std::memcpy(grid->rowData(row), from, sizes.row);
    }
    for (std::size_t i = 0; sizes.voids > 0 && i < std::size_t{header.width} * header.height; ++i) {
        if ((plain[sizes.samples + i / 8] >> (i % 8) & std::byte{1}) != std::byte{0}) {
            grid->markVoid(i % header.width, i / header.width);
        }
    }
    Tile tile{.id = id, .samples = std::move(grid).value(), .filled_m = {}};
    if (sizes.fills > 0) {
        tile.filled_m.resize(sizes.fills / sizeof(float));
        std::memcpy(tile.filled_m.data(), plain.data() + sizes.samples + sizes.voids, sizes.fills);
    }
    return tile;
}

} // namespace

std::vector<std::byte> encodeTileFile(const Tile& tile, const std::string& key)
{
    const SampleGrid& grid = tile.samples;
    MARSVIEW_CHECK(grid.columns() <= kTileSide && grid.rows() <= kTileSide);
    MARSVIEW_CHECK(tile.filled_m.empty() || tile.filled_m.size() == grid.columns() * grid.rows());
    Header header;
    header.key_bytes = static_cast<std::uint32_t>(key.size());
    header.column = tile.id.column;
    header.row = tile.id.row;
    header.width = static_cast<std::uint16_t>(grid.columns());
    header.height = static_cast<std::uint16_t>(grid.rows());
    header.kind = static_cast<std::uint8_t>(tile.id.kind);
    header.level = tile.id.level;
    header.type = static_cast<std::uint8_t>(grid.type());
    header.parts = static_cast<std::uint8_t>((grid.hasVoids() ? kHasVoids : 0) |
                                             (tile.filled_m.empty() ? 0 : kHasFills));
    try {
        const std::vector<std::byte> plain = plainParts(tile, header, sizesOf(header, grid.type()));
        const std::vector<std::byte> stream = deflated(plain, kEffort);
        std::vector<std::byte> file(sizeof header + key.size() + stream.size());
        std::memcpy(file.data() + sizeof header, key.data(), key.size());
        std::memcpy(file.data() + sizeof header + key.size(), stream.data(), stream.size());
        std::memcpy(file.data(), &header, sizeof header);
        header.checksum = checksumOf(file);
        std::memcpy(file.data(), &header, sizeof header);
        return file;
    } catch (const std::bad_alloc&) {
        return {};
    }
}

DecodedTileFile decodeTileFile(std::span<const std::byte> file,
                               const TileId& id,
                               const TileLayout& layout,
                               const std::string& key)
{
    Header header;
    if (file.size() < sizeof header || file.size() > kTileFileBytesMax) {
        return {};
    }
    std::memcpy(&header, file.data(), sizeof header);
    if (header.magic != kMagic || header.checksum != checksumOf(file) ||
        header.key_bytes > file.size() - sizeof header) {
        return {};
    }
    if (header.key_bytes != key.size() ||
        std::memcmp(file.data() + sizeof header, key.data(), key.size()) != 0 ||
        header.kind != static_cast<std::uint8_t>(id.kind) || header.level != id.level ||
        header.column != id.column || header.row != id.row) {
        return {TileFileState::OfAnother, std::nullopt};
    }
    if (header.width != layout.tileWidth(id) || header.height != layout.tileHeight(id) ||
        header.type != static_cast<std::uint8_t>(layout.type)) {
        return {};
    }
    const Sizes sizes = sizesOf(header, layout.type);
    try {
        std::vector<std::byte> plain(sizes.all());
        if (!inflate(file.subspan(sizeof header + key.size()), plain)) {
            return {};
        }
        std::optional<Tile> tile = tileFrom(plain, id, header, layout.type, sizes);
        // Without memory the tile counts as missing; the file may stay.
        return {tile ? TileFileState::Good : TileFileState::OfAnother, std::move(tile)};
    } catch (const std::bad_alloc&) {
        return {TileFileState::OfAnother, std::nullopt};
    }
}

} // namespace marsview
