// Stores tiles in the order of the map's rows, whatever the order in which threads measure them.
#pragma once

#include "core/base/result.h"
#include "core/prepare/level_file_writer.h"
#include "core/tiles/tile.h"

#include <compare>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

namespace marsview {

/// The last row of level-0 tiles with samples in a row of tiles of a level of Samples.
std::size_t lastTileRowOf(const TileLayout& layout, std::size_t level, std::size_t tile_row);
/// The first one.
std::size_t firstTileRowOf(const TileLayout& layout, std::size_t level, std::size_t tile_row);

/// Appends the tiles of rows of level-0 tiles to a file: row by row, each by level and column.
/// Equal maps become equal files, on any number of threads. Any thread.
class OrderedTiles {
public:
    /// With a null `writer`, tiles are dropped.
    explicit OrderedTiles(LevelFileWriter* writer)
        : writer_(writer)
    {}

    /// Appends tiles as they are put instead: wide rows of them need not fit in memory.
    void appendAtOnce() { is_ordered_ = false; }
    /// Rows before this one are in the file. For the thread that starts the others.
    void startAt(std::size_t tile_row) { next_row_ = tile_row; }

    struct Place {
        std::size_t tile_row = 0; // of level 0: the last one that the tile depends on
        std::size_t level = 0;
        std::size_t row =
            0; // of the level: at the end of a map two may depend on one row of level 0
        std::size_t column = 0;
        auto operator<=>(const Place&) const = default;
    };
    /// Called once the tile is in the file, from any thread, one at a time.
    using Stored = std::function<void(const FilePart& part)>;
    /// Before done() of its row, or at least of one of the rows before it.
    void put(const Place& place, std::vector<std::byte> bytes, Stored stored);

    /// Every row is done once, in any order. Errors are those of the file.
    Status done(std::size_t tile_row);

private:
    struct Waiting {
        std::vector<std::byte> bytes;
        Stored stored;
    };

    LevelFileWriter* writer_;
    std::mutex mutex_; // guards the following
    bool is_ordered_ = true;
    std::optional<Error> failure_; // of put()
    std::size_t next_row_ = 0;
    std::map<Place, Waiting> waiting_;
    std::set<std::size_t> done_; // rows from next_row_ on
};

} // namespace marsview
