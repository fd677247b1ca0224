// Reads a raster by rows of tiles, ahead of their use.
#pragma once

#include "core/base/result.h"
#include "core/prepare/row_memory.h"
#include "core/raster/raster_file.h"
#include "core/raster/raster_info.h"

#include <cstddef>
#include <cstdint>
#include <functional>

namespace marsview {

/// Rows of tiles of a raster that is read once, in the order of its rows. For one thread.
///
/// Rows that lie in scratch files are read in pieces: of some columns if the source has tiles, of
/// some whole rows if it has strips. Only blocks that two pieces share are read twice.
class SourceRows {
public:
    /// `info` is that of `source` with the user's overrides; both outlive the object.
    SourceRows(RasterFile& source, const RasterInfo& info, RowMemory memory = {});

    /// Samples of one row of tiles: rows of `grid` from `grid_row` on.
    using Work =
        std::function<Status(const SampleGrid& grid, std::size_t grid_row, std::size_t tile_row)>;
    /// Calls `work` for rows of tiles [first, end), and reads the following ones meanwhile.
    Status each(std::size_t first, std::size_t end, const Work& work);

    /// Read so far, by all calls.
    std::uint64_t samplesRead() const noexcept { return samples_read_; }

private:
    Result<LoadedSamples> read(std::size_t row, std::size_t rows);

    RasterFile& source_;
    const RasterInfo& info_;
    RowMemory memory_;
    std::size_t window_rows_; // read at once: whole rows of tiles and, if they fit, of blocks
    bool reads_ahead_;
    std::uint64_t samples_read_ = 0;
};

} // namespace marsview
