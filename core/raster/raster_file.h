// Reads elevation rasters through GDAL.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/files/shared_file.h"
#include "core/raster/grid_window.h"
#include "core/raster/raster_info.h"
#include "core/raster/sample_grid.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace marsview {

/// Samples in memory with their statistics.
struct LoadedSamples {
    SampleGrid grid;
    SampleStatistics statistics;
};

/// An open raster. For one thread at a time, as GDAL's datasets are: open it again for another
/// thread, which shares the open files of this one (shared_file.h). The user's file is never
/// written to.
class RasterFile {
public:
    /// Opens any elevation raster that GDAL supports: files, labels, headers, archives
    /// (archive_rasters.h), folders of adjoining rasters (mosaic.h), GDAL's connection strings.
    /// Scale, offset, unit and nodata come from the product's label if there is one
    /// (label_elevation.h). Refuses pictures (color, indexed), complex numbers and implausibly
    /// large rasters. `band` counts from 1. Anything but a plain file is opened in a child process
    /// first, within limits of time and memory (open_guard.h); the thread's OpeningJob cancels
    /// that. A file shorter than its header requires is refused.
    ///
    /// Error messages begin with the path.
    static Result<RasterFile> open(const std::string& path, int band = 1);

    RasterFile(RasterFile&&) noexcept;
    RasterFile& operator=(RasterFile&&) noexcept;
    ~RasterFile();

    const RasterInfo& info() const noexcept;

    /// The files of the raster, as GDAL lists them, with overviews and statistics next to it; empty
    /// on a server.
    std::vector<std::string> files() const;
    /// The files that were opened for the raster. Copies keep them open, for rasters that other
    /// threads open later.
    const OpenFiles& openFiles() const noexcept;
    /// Checks that raw data is as long as its header requires; fails with the message of a read.
    /// For other formats only reading can show this.
    Status checkComplete() const;

    /// All samples. Reports progress after every few megabytes and stops within one such step when
    /// canceled. TooLarge if they need more than `memory_bytes_max`.
    ///
    /// `voids` replaces the file's nodata value; masks always apply.
    Result<LoadedSamples>
    readAll(JobMonitor& monitor, const VoidRule& voids, std::size_t memory_bytes_max);

    /// The samples of a window that lies within the raster.
    Result<LoadedSamples> readWindow(const GridWindow& window, const VoidRule& voids);

    /// Overviews in the file: smaller versions of the band, the largest first; most files have
    /// none.
    std::size_t overviewCount() const noexcept;
    GridSize overviewSize(std::size_t overview) const;
    /// The samples of a window that lies within an overview.
    Result<LoadedSamples>
    readOverview(std::size_t overview, const GridWindow& window, const VoidRule& voids);
    /// How the file stores its samples: columns and rows that are decoded together.
    GridSize blockSize() const;
    /// Whether reading consecutive whole rows takes only the memory of the rows, whatever the block
    /// size.
    bool hasCheapRows() const noexcept;

    /// Range and void count without keeping the samples: less than 300 MB on a raster of any size.
    /// TooLarge if a single block takes more.
    Result<SampleStatistics> scan(JobMonitor& monitor, const VoidRule& voids);

private:
    struct Impl;
    explicit RasterFile(std::unique_ptr<Impl> impl);

    std::unique_ptr<Impl> impl_;
};

/// Half of the machine's memory: the default limit for a single map.
std::size_t defaultMemoryBudget();

/// Lets GDAL cache decoded blocks in its default share of the memory, 5 %, unless the user set
/// GDAL_CACHEMAX: for reads that revisit blocks in any order. Without this call the cache holds 32
/// MB. May be called before or after the first raster is opened.
void allowLargeBlockCache();

} // namespace marsview
