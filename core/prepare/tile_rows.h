// Reads a raster by rows of tiles, on all cores.
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

/// The rows to process, and the time until which a row may be started.
struct RowSpan {
    std::size_t first = 0;
    std::size_t end = 0;
    std::chrono::steady_clock::time_point until = std::chrono::steady_clock::time_point::max();
};

/// Readers for any number of threads, opened when needed. Any thread.
class TileReaders {
public:
    TileReaders(const TileSource& source, std::size_t threads_max)
        : source_(source)
        , threads_max_(threads_max)
    {}

    using Work = std::function<Status(TileReader& reader, std::size_t row)>;
    /// Calls `work` for rows in ascending order as threads become free, for at least one row, until
    /// one fails. Returns the first row that was not started; all rows before it are done. Errors:
    /// that of `work`, or Canceled.
    Result<std::size_t> eachRow(const RowSpan& rows, const Work& work, const JobMonitor& monitor);

private:
    Result<std::unique_ptr<TileReader>> take();

    const TileSource& source_;
    std::size_t threads_max_;
    std::mutex mutex_; // guards idle_
    std::vector<std::unique_ptr<TileReader>> idle_;
};

/// The tile. Errors: those of the reader, Canceled, or a tile of an unexpected kind or size.
Result<Tile>
readTile(TileReader& reader, const TileSource& source, const TileId& id, const JobMonitor& monitor);

} // namespace marsview
