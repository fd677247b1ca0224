// A first look at a raster of any size: some of its samples, evenly spread over all of it.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/raster/raster_file.h"

#include <chrono>
#include <cstddef>
#include <functional>

namespace marsview {

struct DecimationLimits {
    std::size_t samples_max = std::size_t{1} << 20; // at least 4
    /// Something finer is begun only where it looks like ending within this time, and given up
    /// where it takes twice as long. The coarsest look is taken in any case, and finer
    /// ones as long as nothing but voids was seen.
    std::chrono::nanoseconds time_max = std::chrono::milliseconds(700);
    /// The time since some moment; empty: that of the clock.
    std::function<std::chrono::nanoseconds()> now{};
};

/// Sample (i, j) of the grid lies in the middle of its share of the raster: the outer corners of
/// the two are the same.
struct DecimatedSamples {
    LoadedSamples loaded; // the statistics are of these samples alone
    /// An overview that the file brings along: means, most likely. Otherwise each sample is that of
    /// the raster in whose pixel it lies.
    bool is_overview = false;
    bool is_finest = true; // more time would not give more samples
};

/// At most `samples_max` samples of the file, from an overview if there is a suitable one,
/// otherwise picked from blocks all over it, coarsely first and finer as long as there is time.
/// Voids are those of `voids` and of the file's mask. On all cores, with files of their own; `file`
/// stays the caller's. Cancelled within the time of reading one row of blocks.
Result<DecimatedSamples> readDecimated(RasterFile& file,
                                       const VoidRule& voids,
                                       const DecimationLimits& limits,
                                       JobMonitor& monitor);

/// The sample in whose pixel lies the middle of part `i` of `count` samples cut into `parts`.
constexpr std::size_t decimatedPlace(std::size_t i, std::size_t parts, std::size_t count) noexcept
{
    return (2 * i + 1) * count / (2 * parts);
}

} // namespace marsview
