// Notation as in TIFF 6.0 and BigTIFF: a file is a chain of directories (IFDs), a directory a list
// of entries (tag, type, count, value or the offset of the values). The lists StripOffsets and
// StripByteCounts, or TileOffsets and TileByteCounts, have an entry for each block.
#include "core/files/tiff_size_check.h"

#include "core/files/shared_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <vector>

namespace marsview {
namespace {

constexpr std::size_t kDirectoriesMax = 64; // overviews and masks of the first raster
constexpr std::uint64_t kEntriesMax = 4096; // of one directory

constexpr std::uint16_t kWidth = 256;
constexpr std::uint16_t kLength = 257;
constexpr std::uint16_t kBitsPerSample = 258;
constexpr std::uint16_t kCompression = 259;
constexpr std::uint16_t kPhotometric = 262;
constexpr std::uint16_t kStripOffsets = 273;
constexpr std::uint16_t kSamplesPerPixel = 277;
constexpr std::uint16_t kRowsPerStrip = 278;
constexpr std::uint16_t kStripByteCounts = 279;
constexpr std::uint16_t kPlanarConfiguration = 284;
constexpr std::uint16_t kTileWidth = 322;
constexpr std::uint16_t kTileLength = 323;
constexpr std::uint16_t kTileOffsets = 324;
constexpr std::uint16_t kTileByteCounts = 325;

constexpr std::uint64_t kSeparatePlanes = 2;
constexpr std::uint64_t kYCbCr = 6; // its blocks hold fewer color samples than pixels

std::uint64_t bytesOfType(std::uint16_t type)
{
    switch (type) {
    case 3: // SHORT
    case 8:
        return 2;
    case 4: // LONG
    case 9:
    case 11: // FLOAT
    case 13:
        return 4;
    case 5: // RATIONAL
    case 10:
    case 12: // DOUBLE
    case 16: // LONG8
    case 17:
    case 18:
        return 8;
    default:
        return 1;
    }
}

// The maximum number of bytes that a stored byte can expand to; empty without a useful bound.
std::optional<std::uint64_t> growthOf(std::uint64_t compression)
{
    switch (compression) {
    case 1: // none
        return 1;
    case 5: // LZW: a code of 9 bits or more expands to up to 4096 bytes
        return 4096;
    case 8: // deflate: at most 1032
    case 32946:
        return 1040;
    case 32773: // PackBits: 2 bytes expand to up to 128
        return 64;
    default:
        return std::nullopt;
    }
}

bool isPlainCompression(std::uint64_t compression)
{
    constexpr std::array<std::uint64_t, 7> kPlainCompressions{1, 5, 8, 32946, 32773, 34925, 50000};
    return std::find(kPlainCompressions.begin(), kPlainCompressions.end(), compression) !=
           kPlainCompressions.end();
}

struct Entry {
    std::uint16_t type = 0;
    std::uint64_t count = 0;
    std::uint64_t place = 0; // offset of the values in the file
};

using Directory = std::map<std::uint16_t, Entry>;

class Reader {
public:
    explicit Reader(const std::string& path)
        : file_(openShared(path))
        , bytes_(file_ ? file_->bytes() : 0)
    {}

    std::uint64_t bytes() const { return bytes_; }

    // Returns zeros beyond the end.
    std::vector<unsigned char> read(std::uint64_t place, std::uint64_t count)
    {
        std::vector<unsigned char> data(count, 0);
        if (place < bytes_) {
            file_->read(data.data(), std::min(count, bytes_ - place), place);
        }
        return data;
    }

    std::uint64_t number(std::uint64_t place, std::uint64_t size)
    {
        return number(read(place, size).data(), size);
    }
    std::uint64_t number(const unsigned char* data, std::uint64_t size) const
    {
        std::uint64_t value = 0;
        for (std::uint64_t i = 0; i < size; ++i) {
            value |= std::uint64_t{data[is_big_endian ? size - 1 - i : i]} << (8 * i);
        }
        return value;
    }
    bool isWithin(std::uint64_t place, std::uint64_t count) const
    {
        return place <= bytes_ && count <= bytes_ - place;
    }

    bool is_big_endian = false;
    bool is_big_tiff = false;

private:
    std::shared_ptr<const SharedFile> file_;
    std::uint64_t bytes_;
};

Error cutShort(const std::string& what)
{
    return Error{ErrorCode::Unreadable,
                 fmt::format("is cut short or damaged: {}; fetch it again", what)};
}

std::uint64_t
valueOf(Reader& reader, const Directory& directory, std::uint16_t tag, std::uint64_t otherwise)
{
    const auto entry = directory.find(tag);
    return entry == directory.end() || entry->second.count == 0
               ? otherwise
               : reader.number(entry->second.place,
                               std::min<std::uint64_t>(8, bytesOfType(entry->second.type)));
}

// "512 B", "67.1 MB"
std::string sizeText(std::uint64_t bytes)
{
    constexpr double kStep = 1e3;
    constexpr std::uint64_t kPlainMax = 9999;
    if (bytes <= kPlainMax) {
        return fmt::format("{} B", bytes);
    }
    constexpr std::array kUnits{"kB", "MB", "GB", "TB", "PB", "EB"};
    double size = static_cast<double>(bytes) / kStep;
    std::size_t unit = 0;
    for (; size >= kStep && unit + 1 < kUnits.size(); ++unit) {
        size /= kStep;
    }
    return fmt::format("{:.1f} {}", size, kUnits[unit]);
}

std::uint64_t timesOrMost(std::uint64_t a, std::uint64_t b)
{
    std::uint64_t product = 0;
    return __builtin_mul_overflow(a, b, &product) ? std::numeric_limits<std::uint64_t>::max()
                                                  : product;
}

struct Blocks {
    std::uint64_t count = 0;
    std::uint64_t bytes_in_full = 0; // decoded, of a block that is not at the lower edge
    std::uint64_t bytes_in_last = 0; // of a strip at the lower edge
    std::uint64_t per_plane = 0;
};

Blocks blocksOf(Reader& reader, const Directory& directory, bool is_tiled)
{
    const auto value = [&](std::uint16_t tag, std::uint64_t otherwise) {
        return valueOf(reader, directory, tag, otherwise);
    };
    const std::uint64_t width = value(kWidth, 0);
    const std::uint64_t length = value(kLength, 0);
    const std::uint64_t samples = std::max<std::uint64_t>(1, value(kSamplesPerPixel, 1));
    const bool is_separate = value(kPlanarConfiguration, 1) == kSeparatePlanes;
    const std::uint64_t bits = timesOrMost(value(kBitsPerSample, 1), is_separate ? 1 : samples);
    const std::uint64_t block_width = is_tiled ? value(kTileWidth, 0) : width;
    const std::uint64_t block_length =
        is_tiled ? value(kTileLength, 0)
                 : std::min(length, value(kRowsPerStrip, std::uint64_t{0xffffffff}));
    Blocks blocks;
    if (block_width == 0 || block_length == 0) {
        return blocks; // the library rejects it
    }
    const auto parts = [](std::uint64_t whole, std::uint64_t part) {
        return whole / part + (whole % part != 0 ? 1 : 0);
    };
    const auto bytes_of_rows = [&](std::uint64_t rows) {
        const std::uint64_t row_bits = timesOrMost(block_width, bits);
        return timesOrMost(row_bits / 8 + (row_bits % 8 != 0 ? 1 : 0), rows);
    };
    blocks.per_plane = timesOrMost(parts(width, block_width), parts(length, block_length));
    blocks.count = timesOrMost(blocks.per_plane, is_separate ? samples : 1);
    blocks.bytes_in_full = bytes_of_rows(block_length);
    const std::uint64_t last_rows = is_tiled ? 0 : length % block_length;
    blocks.bytes_in_last = last_rows == 0 ? blocks.bytes_in_full : bytes_of_rows(last_rows);
    return blocks;
}

Status checkBlocks(Reader& reader, const Directory& directory)
{
    const bool is_tiled = directory.contains(kTileWidth) || directory.contains(kTileOffsets);
    const auto list = [&](std::uint16_t strips, std::uint16_t tiles) {
        const auto found = directory.find(is_tiled && directory.contains(tiles) ? tiles : strips);
        return found == directory.end() ? nullptr : &found->second;
    };
    const Entry* const offsets = list(kStripOffsets, kTileOffsets);
    const Entry* const sizes = list(kStripByteCounts, kTileByteCounts);
    const Blocks blocks = blocksOf(reader, directory, is_tiled);
    if (offsets == nullptr || blocks.count == 0) {
        return Done{}; // as the library treats it
    }
    for (const Entry* entry : {offsets, sizes}) {
        if (entry != nullptr && entry->count < blocks.count) {
            return cutShort(fmt::format("it declares {} blocks of samples but lists {}",
                                        blocks.count, entry->count));
        }
    }
    if (sizes == nullptr) {
        return Done{};
    }
    const std::uint64_t offset_bytes = bytesOfType(offsets->type);
    const std::uint64_t size_bytes = bytesOfType(sizes->type);
    const std::uint64_t compression = valueOf(reader, directory, kCompression, 1);
    const auto growth = valueOf(reader, directory, kPhotometric, 1) == kYCbCr
                            ? std::nullopt
                            : growthOf(compression);
    // The library computes the length of a single uncompressed block itself.
    const bool is_length_known = compression == 1 && blocks.count == 1 && growth;
    constexpr std::uint64_t kAtOnce = 65536;
    for (std::uint64_t first = 0; first < blocks.count; first += kAtOnce) {
        const std::uint64_t count = std::min(kAtOnce, blocks.count - first);
        const auto places =
            reader.read(offsets->place + first * offset_bytes, count * offset_bytes);
        const auto lengths = reader.read(sizes->place + first * size_bytes, count * size_bytes);
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint64_t place =
                reader.number(places.data() + i * offset_bytes, offset_bytes);
            const std::uint64_t length =
                is_length_known && place != 0
                    ? blocks.bytes_in_last
                    : reader.number(lengths.data() + i * size_bytes, size_bytes);
            if (place == 0 || length == 0) {
                continue; // omitted: all nodata
            }
            if (!reader.isWithin(place, length)) {
                return cutShort(
                    fmt::format("block {} of {} ends at byte {}, the file at byte {}",
                                first + i + 1, blocks.count,
                                place > std::numeric_limits<std::uint64_t>::max() - length
                                    ? std::numeric_limits<std::uint64_t>::max()
                                    : place + length,
                                reader.bytes()));
            }
            const bool is_last = (first + i) % blocks.per_plane == blocks.per_plane - 1;
            const std::uint64_t decoded = is_last ? blocks.bytes_in_last : blocks.bytes_in_full;
            if (growth && timesOrMost(length, *growth) < decoded) {
                return cutShort(
                    fmt::format("block {} of {} has {} bytes, too few for its {} of "
                                "samples",
                                first + i + 1, blocks.count, length, decoded));
            }
        }
    }
    return Done{};
}

// Lists longer than this count; short ones, such as metadata of other programs, may be damaged
// without harm to samples.
bool isList(std::uint16_t tag)
{
    return tag == kStripOffsets || tag == kStripByteCounts || tag == kTileOffsets ||
           tag == kTileByteCounts;
}

} // namespace

std::optional<TiffSizes> tiffSizesOf(const std::string& path)
{
    Reader reader(path);
    constexpr std::uint64_t kHeaderBytes = 8;
    if (reader.bytes() < kHeaderBytes) {
        return std::nullopt;
    }
    const auto magic = reader.read(0, 4);
    const bool is_intel = magic[0] == 'I' && magic[1] == 'I';
    reader.is_big_endian = magic[0] == 'M' && magic[1] == 'M';
    const std::uint64_t version = reader.number(magic.data() + 2, 2);
    if (!(is_intel || reader.is_big_endian) || (version != 42 && version != 43)) {
        return std::nullopt;
    }
    reader.is_big_tiff = version == 43;
    const std::uint64_t word = reader.is_big_tiff ? 8 : 4;        // bytes of offsets and counts
    const std::uint64_t count_bytes = reader.is_big_tiff ? 8 : 2; // of a directory's entries
    const std::uint64_t entry_bytes = 4 + 2 * word;
    TiffSizes promise;
    std::set<std::uint64_t> seen;
    std::uint64_t place = reader.number(reader.is_big_tiff ? 8 : 4, word);
    while (place != 0 && seen.size() < kDirectoriesMax) {
        if (!seen.insert(place).second) {
            promise.fits = cutShort("its directories form a loop");
            return promise;
        }
        const std::uint64_t entries = reader.number(place, count_bytes);
        if (!reader.isWithin(place, count_bytes) || entries > kEntriesMax ||
            !reader.isWithin(place + count_bytes, entries * entry_bytes)) {
            // Later directories, overviews and masks, are optional for the library.
            if (seen.size() == 1) {
                promise.fits = cutShort("its directory is beyond the end of the file");
            }
            return promise;
        }
        const auto table = reader.read(place + count_bytes, entries * entry_bytes);
        Directory directory;
        for (std::uint64_t i = 0; i < entries; ++i) {
            const unsigned char* at = table.data() + i * entry_bytes;
            const auto tag = static_cast<std::uint16_t>(reader.number(at, 2));
            Entry entry{.type = static_cast<std::uint16_t>(reader.number(at + 2, 2)),
                        .count = reader.number(at + 4, word),
                        .place = 0};
            const std::uint64_t bytes = timesOrMost(entry.count, bytesOfType(entry.type));
            entry.place = bytes <= word ? place + count_bytes + i * entry_bytes + 4 + word
                                        : reader.number(at + 4 + word, word);
            if (isList(tag) && !reader.isWithin(entry.place, bytes)) {
                promise.fits =
                    cutShort(fmt::format("it declares a list of {} blocks of samples that takes "
                                         "{}, but the whole file has {}",
                                         entry.count, sizeText(bytes), sizeText(reader.bytes())));
                return promise;
            }
            directory.try_emplace(tag, entry);
        }
        promise.is_plain =
            promise.is_plain && isPlainCompression(valueOf(reader, directory, kCompression, 1));
        if (Status blocks = checkBlocks(reader, directory); !blocks) {
            promise.fits = std::move(blocks);
            return promise;
        }
        place = reader.number(place + count_bytes + entries * entry_bytes, word);
    }
    return promise;
}

} // namespace marsview
