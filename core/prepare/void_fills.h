// Fills of voids on maps whose finest means do not fit in memory.
#pragma once

#include "core/base/result.h"
#include "core/levels/tile_fill.h"
#include "core/prepare/checkpoint_file.h"
#include "core/prepare/tile_counts.h"
#include "core/terrain/block_means.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace marsview {

/// The means of blocks of 8 × 8 samples, and of larger blocks up to those in memory, in files: one
/// of the whole map, or one of each part. A file that was opened for writing stays until it is
/// removed by its owner. Any thread, but for add().
class FineMeans {
public:
    enum class Content : std::uint8_t { Empty, AsItWas };

    FineMeans() = default;
    /// Without files. `kept` are the blocks in memory.
    explicit FineMeans(const BlockExtent& kept);
    /// Opens `path` for the blocks of these rows; it is not created if there are no finer blocks.
    static Result<FineMeans> open(const BlockExtent& kept,
                                  const std::string& path,
                                  Content content,
                                  const TileRowRange& rows);

    std::size_t levelCount() const noexcept { return levels_.size(); }
    const BlockExtent& extent(std::size_t level) const noexcept { return levels_[level]; }
    /// Whole rows of a level, of one file.
    Status write(std::size_t level, const BlockRows& rows);
    /// Reads rows.heights_m, whose size is the requested one, from rows.first_row on, and compares
    /// them with their checksums.
    Status read(std::size_t level, BlockRows& rows) const;
    /// Flushes all written data to the disk and writes its checksums to `to`. False on failure.
    bool save(CheckpointWriter& to) const;
    /// The latter alone.
    void saveChecksums(CheckpointWriter& to) const;
    /// Whether the file is the same as at save(). Reads the whole file.
    bool restore(CheckpointReader& from);

    /// Adds the means of other rows, from the file that save() was called for. It is opened only to
    /// be read, and few are open at a time. False if `from` is not from save() for such rows.
    bool add(CheckpointReader& from, const std::string& path, const TileRowRange& rows);

private:
    struct Close {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };
    struct BlockRowRange {
        std::size_t first = 0;
        std::size_t end = 0;
    };
    struct File {
        std::string path;
        std::vector<BlockRowRange> rows; // by level
        // For each of these rows: 0 if it was not written, otherwise its CRC-32 plus 1.
        std::vector<std::vector<std::uint64_t>> checksums;
        std::unique_ptr<std::FILE, Close> open;
    };

    File fileOf(const std::string& path, const TileRowRange& rows) const;
    File* fileWith(std::size_t level, std::size_t row) const;
    long offsetOf(const File& file, std::size_t level, std::size_t row) const;
    static bool restoreChecksums(File& file, CheckpointReader& from);
    void openToRead(File& file) const;

    std::vector<BlockExtent> levels_;
    std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>(); // guards the files
    std::vector<std::unique_ptr<File>> files_;                           // in any order of rows
    mutable std::vector<File*> opened_; // by openToRead(), the first one first
};

/// The rows of the finest blocks around a row of level-0 tiles, with gaps filled as in BlockMeans.
/// `kept` continues where `fine` ends.
Result<BlockRows> filledRows(const FineMeans& fine, const BlockMeans& kept, std::size_t tile_row);

/// The part of them that a tile of that row needs.
TileFill tileFill(const BlockRows& filled, const TileLayout& layout, const TileId& id);

} // namespace marsview
