// Reading a raster row of tiles by row of tiles, on all cores.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/tiles/tile_source.h"

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace marsview {

/// Which rows are worked on, and until when one may be begun.
struct RowSpan {
    std::size_t first = 0;
    std::size_t end = 0;
    std::chrono::steady_clock::time_point until = std::chrono::steady_clock::time_point::max();
};

/// Readers for as many threads as ask, opened when needed. Any thread.
class TileReaders {
public:
    TileReaders(const TileSource& source, std::size_t threads_max)
        : source_(source)
        , threads_max_(threads_max)
    {}

    using Work = std::function<Status(TileReader& reader, std::size_t row)>;
    /// Calls `work` for rows in ascending order as threads get free, at least for one, until one
    /// fails: its error, or Cancelled. Returns the first row that was not begun; all before it are
    /// done.
    Result<std::size_t> eachRow(const RowSpan& rows, const Work& work, const JobMonitor& monitor);

private:
    Result<std::unique_ptr<TileReader>> take();

    const TileSource& source_;
    std::size_t threads_max_;
    std::mutex mutex_; // of idle_
    std::vector<std::unique_ptr<TileReader>> idle_;
};

/// The tile, or an error: what reading says, Cancelled, or that the reader gave something else.
Result<Tile>
readTile(TileReader& reader, const TileSource& source, const TileId& id, const JobMonitor& monitor);

} // namespace marsview
