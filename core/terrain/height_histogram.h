// The distribution of a map's elevations.
#pragma once

#include "core/base/job_monitor.h"
#include "core/terrain/heightfield.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace marsview {

struct HeightHistogram {
    HeightRange range;                 // of all samples of the map
    std::vector<std::uint64_t> counts; // of equal bins of the range, lowest first
    std::uint64_t sample_count = 0;    // valid samples that were counted: the sum of counts
    std::size_t stride = 1;            // stride of the counted columns and rows
};

struct HistogramOptions {
    std::size_t bin_count = 64; // at least 1
    std::size_t sample_count_max = 1'000'000;
    /// May be null. After a cancel, the remaining tiles are not counted.
    const JobMonitor* monitor = nullptr;
};

/// Counts the samples of every stride-th column of every stride-th row, with the smallest stride
/// that counts at most `sample_count_max`. No counts if every sample is void. If all heights are
/// equal, they fall into the first bin. Some 10 ns per sample: not for the GUI thread.
HeightHistogram heightHistogram(const Heightfield& heights, const HistogramOptions& options = {});

} // namespace marsview
