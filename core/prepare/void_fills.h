// What voids are filled with on maps whose finest means do not fit in memory.
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

/// The means of blocks of 8 × 8 samples and of those up to the blocks that are kept in memory, in a
/// file that goes with the object, but stays where the program is killed. Any thread.
class FineMeans {
public:
    enum class Content : std::uint8_t { Empty, AsItWas };

    /// `kept` are the blocks that are not in here. The file is `path`; there is none where no
    /// blocks are finer than those.
    static Result<FineMeans>
    open(const BlockExtent& kept, const std::string& path, Content content);
    FineMeans() = default;
    FineMeans(FineMeans&&) noexcept = default;
    FineMeans& operator=(FineMeans&&) noexcept = default;

    std::size_t levelCount() const noexcept { return levels_.size(); }
    const BlockExtent& extent(std::size_t level) const noexcept { return levels_[level]; }
    /// Whole rows of a level.
    Status write(std::size_t level, const BlockRows& rows);
    /// Fills rows.heights_m, which has the size of what is wanted, from rows.first_row on.
    Status read(std::size_t level, BlockRows& rows) const;
    /// All that was written is on the disk from here on, whatever becomes of the machine, and `to`
    /// tells it from anything else. False where that cannot be.
    bool save(CheckpointWriter& to) const;
    /// Whether the file holds what it held at save(). Reads it.
    bool restore(CheckpointReader& from);

private:
    struct Close {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };

    long offsetOf(std::size_t level, std::size_t row) const;

    std::string name_; // for messages
    std::vector<BlockExtent> levels_;
    // Of each row of each level: 0 where it was not written, else one more than its CRC-32.
    std::vector<std::vector<std::uint64_t>> row_checksums_;
    std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
    std::unique_ptr<std::FILE, Close> file_; // none where there are no levels
};

/// The rows of the finest blocks around a row of level-0 tiles, gaps filled as BlockMeans does.
/// `kept` continues where `fine` ends.
Result<BlockRows> filledRows(const FineMeans& fine, const BlockMeans& kept, std::size_t tile_row);

/// What a tile of that row needs of them.
TileFill tileFill(const BlockRows& filled, const TileLayout& layout, const TileId& id);

} // namespace marsview
