// Reading elevation rasters. This is the only place that reads through GDAL.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/raster/grid_window.h"
#include "core/raster/raster_info.h"
#include "core/raster/sample_grid.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace marsview {

/// Samples in memory, and what they hold.
struct LoadedSamples {
    SampleGrid grid;
    SampleStatistics statistics;
};

/// An open raster. For one thread at a time; open it again for another thread. The user's file is
/// never written to.
class RasterFile {
public:
    /// Opens anything that holds elevations and that GDAL understands: files, labels, headers,
    /// archives (archive_rasters.h), folders of adjoining rasters (mosaic.h), GDAL's connection
    /// strings. Scale, offset, unit and nodata are those of the product's label where there is one
    /// (label_elevation.h). Refuses pictures (colour, indexed), complex numbers and what is
    /// absurdly large. `band` counts from 1. What is not a plain file is opened in a child process
    /// first, within limits of time and memory (open_guard.h); the thread's OpeningJob cancels
    /// that. A file that cannot hold what its header promises is refused.
    ///
    /// Error messages begin with the path.
    static Result<RasterFile> open(const std::string& path, int band = 1);

    RasterFile(RasterFile&&) noexcept;
    RasterFile& operator=(RasterFile&&) noexcept;
    ~RasterFile();

    const RasterInfo& info() const noexcept;

    /// The files that it is made of, as GDAL names them, with overviews and statistics that lie
    /// beside it; at a server none.
    std::vector<std::string> files() const;
    /// Whether raw data is as long as its header promises: the message that reading would fail
    /// with. Of other formats only reading can tell.
    Status checkComplete() const;

    /// All samples. Reports progress after every few megabytes and stops within one such step when
    /// cancelled. TooLarge where they need more than `memory_bytes_max`.
    ///
    /// `voids` replaces the file's nodata value, masks apply in any case.
    Result<LoadedSamples>
    readAll(JobMonitor& monitor, const VoidRule& voids, std::size_t memory_bytes_max);

    /// The samples of a window that lies within the raster.
    Result<LoadedSamples> readWindow(const GridWindow& window, const VoidRule& voids);

    /// Smaller versions of the band that the file brings along, the largest first; most files have
    /// none.
    std::size_t overviewCount() const noexcept;
    GridSize overviewSize(std::size_t overview) const;
    /// The samples of a window that lies within an overview.
    Result<LoadedSamples>
    readOverview(std::size_t overview, const GridWindow& window, const VoidRule& voids);
    /// How the file stores its samples: columns and rows that are decoded together.
    GridSize blockSize() const;
    /// Whole rows, read one after the other, take no more than they are, however large the blocks.
    bool hasCheapRows() const noexcept;

    /// Range and void count without keeping the samples: less than 300 MB on a raster of any size.
    /// TooLarge where a single block of it takes more.
    Result<SampleStatistics> scan(JobMonitor& monitor, const VoidRule& voids);

private:
    struct Impl;
    explicit RasterFile(std::unique_ptr<Impl> impl);

    std::unique_ptr<Impl> impl_;
};

/// Half of the machine's memory: what a single map may take by default.
std::size_t defaultMemoryBudget();

/// Lets GDAL hold its default share of the memory, 5 %, in decoded blocks, unless the user set
/// GDAL_CACHEMAX: for reads that come back to blocks in any order. Otherwise it holds 32 MB. Before
/// the first raster is opened or after.
void allowLargeBlockCache();

} // namespace marsview
