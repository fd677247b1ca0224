// Fills of voids on maps whose finest means do not fit in memory.
#pragma once

#include "core/base/result.h"
#include "core/levels/tile_fill.h"
#include "core/prepare/checkpoint_file.h"
#include "core/terrain/block_means.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace marsview {

/// The means of blocks of 8 × 8 samples, and of larger blocks up to those in memory, in a file. The
/// file is removed with the object, but stays if the program is killed. Any thread.
class FineMeans {
public:
    enum class Content : std::uint8_t { Empty, AsItWas };

    /// `kept` are the blocks in memory. The file is `path`; it is not created if there are no finer
    /// blocks.
    static Result<FineMeans>
    open(const BlockExtent& kept, const std::string& path, Content content);
    FineMeans() = default;
    FineMeans(FineMeans&&) noexcept = default;
    FineMeans& operator=(FineMeans&&) noexcept = default;

    std::size_t levelCount() const noexcept { return levels_.size(); }
    const BlockExtent& extent(std::size_t level) const noexcept { return levels_[level]; }
    /// Whole rows of a level.
    Status write(std::size_t level, const BlockRows& rows);
    /// Reads rows.heights_m, whose size is the requested one, from rows.first_row on.
    Status read(std::size_t level, BlockRows& rows) const;
    /// Flushes all written data to the disk and writes its checksums to `to`. False on failure.
    bool save(CheckpointWriter& to) const;
    /// Whether the file is the same as at save(). Reads the whole file.
    bool restore(CheckpointReader& from);

private:
    struct Close {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };

    long offsetOf(std::size_t level, std::size_t row) const;

    std::string name_; // for messages
    std::vector<BlockExtent> levels_;
    // For each row of each level: 0 if it was not written, otherwise its CRC-32 plus 1.
    std::vector<std::vector<std::uint64_t>> row_checksums_;
    std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
    std::unique_ptr<std::FILE, Close> file_; // null without levels
};

/// The rows of the finest blocks around a row of level-0 tiles, with gaps filled as in BlockMeans.
/// `kept` continues where `fine` ends.
Result<BlockRows> filledRows(const FineMeans& fine, const BlockMeans& kept, std::size_t tile_row);

/// The part of them that a tile of that row needs.
TileFill tileFill(const BlockRows& filled, const TileLayout& layout, const TileId& id);

} // namespace marsview
