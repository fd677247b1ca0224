// Reading elevation rasters. This is the only place that reads through GDAL.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/raster/raster_info.h"
#include "core/raster/sample_grid.h"

#include <cstddef>
#include <memory>
#include <string>

namespace marsview {

/// A rectangle of samples: columns [column, column + columns), rows likewise.
struct GridWindow {
    std::size_t column = 0;
    std::size_t row = 0;
    std::size_t columns = 0;
    std::size_t rows = 0;
};

/// Samples in memory, and what they hold.
struct LoadedSamples {
    SampleGrid grid;
    SampleStatistics statistics;
};

/// Columns and rows.
struct GridSize {
    std::size_t columns = 0;
    std::size_t rows = 0;
    bool operator==(const GridSize&) const = default;
};

/// An open raster. For one thread at a time; open it again for another thread. The user's file is
/// never written to.
class RasterFile {
public:
    /// Opens anything that holds elevations and that GDAL understands: files, labels, headers,
    /// archives with one raster, GDAL's connection strings. Refuses pictures (colour, indexed),
    /// complex numbers and what is absurdly large. `band` counts from 1.
    ///
    /// Error messages begin with the path.
    static Result<RasterFile> open(const std::string& path, int band = 1);

    RasterFile(RasterFile&&) noexcept;
    RasterFile& operator=(RasterFile&&) noexcept;
    ~RasterFile();

    const RasterInfo& info() const noexcept;

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

    /// Range and void count without keeping the samples: bounded memory on a raster of any size.
    Result<SampleStatistics> scan(JobMonitor& monitor, const VoidRule& voids);

private:
    struct Impl;
    explicit RasterFile(std::unique_ptr<Impl> impl);

    std::unique_ptr<Impl> impl_;
};

/// Half of the machine's memory: what a single map may take by default.
std::size_t defaultMemoryBudget();

/// The version of GDAL in use, "3.6.2".
std::string gdalVersion();

} // namespace marsview
