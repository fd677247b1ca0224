// How the heights of a map are distributed.
#pragma once

#include "core/base/job_monitor.h"
#include "core/terrain/heightfield.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace marsview {

struct HeightHistogram {
    HeightRange range;                 // of all samples of the map
    std::vector<std::uint64_t> counts; // equal parts of the range, lowest first
    std::uint64_t sample_count = 0;    // that were looked at and are not void: the sum of counts
    std::size_t stride = 1;            // every how many-th column and row was looked at
};

struct HistogramOptions {
    std::size_t bin_count = 64; // at least 1
    std::size_t sample_count_max = 1'000'000;
    /// May be null. Where it is cancelled, what is left of a map in tiles is not counted.
    const JobMonitor* monitor = nullptr;
};

/// Counts the samples of every stride-th column of every stride-th row, with the smallest stride
/// that looks at no more than `sample_count_max`. Without counts where every sample is void.
/// Heights all equal fall into the first part. Some 10 ns a sample: not for the GUI thread.
HeightHistogram heightHistogram(const Heightfield& heights, const HistogramOptions& options = {});

} // namespace marsview
