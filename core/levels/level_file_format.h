// The file format of level files.
//
//   preamble   64 bytes, below
//   tiles      nested samples of levels >= LevelFile::kFirstLevel; fills of tiles with voids
//   planes     arrays measured over the whole map, in chunks
//   tail       planes that locate the tiles, and the header
//
// Numbers are little-endian. The preamble:
//
//    0  8 bytes  \x89 M V L \r \n \x1a \n
//    8  u32      version
//   12  u32      CRC-32 of the header
//   16  u64      size of the file in bytes
//   24  u64      offset of the planes, which end at the tail
//   32  u64      offset of the tail, which ends at the end of the file
//   40  u64      offset of the header, which ends at the end of the file
//   48  u64, u32 0
//   60  u32      CRC-32 of the preceding 60 bytes
//
// The header is JSON: the source (LevelFileKey), the layout, the statistics, the scale of the
// heights in meters, and for every plane its chunks, each [offset, bytes, CRC-32]. Numbers that
// JSON cannot represent are strings: "nan", "inf", "-inf".
//
// A plane is an array of numbers, in chunks of whole rows, about 1 MiB before packing
// (core/levels/packing.h). The planes, in this order:
//
//   ranges           RawRanges: smallest and largest raw value, alternating
//   errors 1, 2, …   DetailErrors of the nodes of each level, float meters
//   means            BlockMeans of blocks of `block_samples`, float meters; NaN if all samples are
//   void
//   shares           fraction of valid samples; only with voids
//   fills            smallest and largest fill of the void samples of each block of RawRanges,
//                    alternating, float meters, inf and -inf without voids; only with voids
//   checksums        TileChecksums of the raster, u32
//   samples index    three rows, u64: offset, bytes, CRC-32 of every tile of samples, level by
//   level fills index      four rows, u64: number, offset, bytes, CRC-32 of every level-0 tile with
//   voids coarse index     the same of the tiles that samples index lists
//
// Derivable data is not stored. A tile of samples is one byte, 1 if a mask follows, and the packed
// samples with the mask: one bit per sample, rows padded to bytes, lowest bit first. The fill of a
// level-0 tile is the packed means, with gaps filled, of its blocks of 8 × 8 samples and of the
// neighboring blocks on the map. The fill of a coarser tile is its packed heights.
#pragma once

#include "core/base/result.h"
#include "core/levels/level_file.h"
#include "core/levels/packing.h"
#include "core/terrain/block_grid.h"
#include "core/tiles/tile.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace marsview {

inline constexpr std::uint32_t kLevelFileVersion = 2;
inline constexpr std::size_t kPreambleBytes = 64;

struct LevelFilePreamble {
    std::uint32_t header_checksum = 0;
    std::uint64_t file_bytes = 0;
    std::uint64_t planes_offset = 0;
    std::uint64_t tail_offset = 0;
    std::uint64_t header_offset = 0;
};

std::array<std::byte, kPreambleBytes> writtenPreamble(const LevelFilePreamble& preamble);
/// Invalid, with a message, if it is not a preamble, or not that of a file of `file_bytes`.
Result<LevelFilePreamble>
readPreamble(std::span<const std::byte> bytes, std::uint64_t file_bytes, const std::string& path);

/// The location of packed data in the file.
struct FilePart {
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
    std::uint32_t checksum = 0;
};

/// An array of the file.
struct LevelPlane {
    std::string name;
    PackShape shape;
    std::vector<FilePart> chunks;

    std::size_t rowsPerChunk() const noexcept;
    std::size_t chunkCount() const noexcept;
    /// The shape of the rows in a chunk.
    PackShape chunkShape(std::size_t chunk) const noexcept;
};

struct LevelFileHeader {
    LevelFileKey key;
    TileLayout layout;
    SampleStatistics statistics;
    ElevationScale scale;
    std::size_t block_samples = 8; // along a side of the finest blocks with stored means
    std::size_t fill_tiles = 0;    // level-0 tiles with voids
    std::size_t coarse_tiles = 0;  // of the tiles with samples in the file
    std::vector<LevelPlane> planes;

    bool hasVoids() const noexcept { return statistics.void_count > 0; }
    BlockExtent blocks() const noexcept { return {layout.columns, layout.rows, block_samples}; }
};

/// The planes that a file with this header has, without their chunks.
std::vector<LevelPlane> planesOf(const LevelFileHeader& header);
/// The number of planes in the tail.
inline constexpr std::size_t kTailPlanes = 3; // the last ones

std::string writtenHeader(const LevelFileHeader& header);
/// Invalid if anything is missing, out of range, or inconsistent with planesOf().
Result<LevelFileHeader>
readHeader(std::span<const std::byte> json, std::uint64_t file_bytes, const std::string& path);

/// The finest blocks with a count of at most `blocks_max`, which is at least 1.
BlockExtent finestBlocks(const TileLayout& layout, std::size_t blocks_max);

/// The number of stored tiles of samples, and the index of a tile among them, level by level and
/// row by row.
std::size_t keptTileCount(const TileLayout& layout);
std::size_t keptTileNumber(const TileLayout& layout, const TileId& id);

/// The blocks of 8 × 8 samples stored for the fill of a level-0 tile: its own and the neighboring
/// ones.
struct FillWindow {
    std::size_t first_column = 0; // in blocks of the map
    std::size_t first_row = 0;
    std::size_t columns = 0;
    std::size_t rows = 0;
};
FillWindow fillWindow(const TileLayout& layout, const TileId& id);

/// A tile of samples in the file's format.
std::vector<std::byte> packedSamples(const SampleGrid& samples);
/// Empty if `bytes` is not such a tile.
std::optional<SampleGrid> unpackSamples(std::span<const std::byte> bytes,
                                        SampleType type,
                                        std::size_t columns,
                                        std::size_t rows);
/// The samples without their mask.
std::vector<std::byte> packedArray(const SampleGrid& samples);

/// "PATH: …; prepare the map again".
Error damaged(const std::string& path, const std::string& what);

} // namespace marsview
