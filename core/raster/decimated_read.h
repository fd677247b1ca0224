// A quick preview of a raster of any size: some of its samples, spread evenly over all of it.
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
    /// A finer preview is started only if it is expected to end within this time, and abandoned if
    /// it takes twice as long. The coarsest preview is always read, and finer ones as long as all
    /// samples were void.
    std::chrono::nanoseconds time_max = std::chrono::milliseconds(700);
    /// The current time since any epoch; empty: the system clock.
    std::function<std::chrono::nanoseconds()> now{};
};

/// Sample (i, j) of the grid lies in the middle of its part of the raster: both have the same outer
/// corners.
struct DecimatedSamples {
    LoadedSamples loaded; // the statistics are of these samples alone
    /// The samples are an overview of the file, which usually holds means. Otherwise each is the
    /// raster's sample in whose pixel it lies.
    bool is_overview = false;
    bool is_finest = true; // more time would not give more samples
};

/// At most `samples_max` samples of the file, from an overview if there is a suitable one,
/// otherwise picked from blocks all over it, coarsely first and finer while time allows. Voids
/// follow `voids` and the file's mask. Runs on all cores, which open the file again; `file` stays
/// with the caller. A cancel takes effect within the time of reading one row of blocks.
Result<DecimatedSamples> readDecimated(RasterFile& file,
                                       const VoidRule& voids,
                                       const DecimationLimits& limits,
                                       JobMonitor& monitor);

/// The sample whose pixel contains the middle of part `i` when `count` samples are divided into
/// `parts`.
constexpr std::size_t decimatedPlace(std::size_t i, std::size_t parts, std::size_t count) noexcept
{
    return (2 * i + 1) * count / (2 * parts);
}

} // namespace marsview
