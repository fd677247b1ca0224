// Reductions of a map for drawing all of it at once. Nothing that a user reads as a number comes
// from here: numbers come from the Heightfield.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/geo/scene_frame.h"
#include "core/terrain/heightfield.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace marsview {

/// Every step-th sample of every step-th row, the last column and row included: vertex (i, j) is
/// sample (min(i · step, last column), min(j · step, last row)).
struct OverviewGrid {
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::size_t step = 1;
    double base_height_m = 0.0; // heights are relative to this, so that floats keep millimetres
    std::vector<float> heights_m;

    float& height(std::size_t column, std::size_t row) { return heights_m[row * columns + column]; }
    float height(std::size_t column, std::size_t row) const
    {
        return heights_m[row * columns + column];
    }
};

struct OverviewLimits {
    std::size_t triangle_count_max = 250'000; // >= 2
    std::size_t side_max = 8192;              // vertices along a side, >= 2
};

/// The finest overview within the limits. Where the sample of a vertex is void, the vertex takes
/// the height of valid ones at most a step away, so that the surface can be cut along the rim of
/// the hole, which ReliefMap knows at a finer scale; NaN where none is near. Only Cancelled can go
/// wrong.
Result<OverviewGrid>
makeOverview(const Heightfield& heightfield, const OverviewLimits& limits, JobMonitor& monitor);

/// What shading needs at every step-th sample: the surface normal, the height, and whether there is
/// a surface at all.
///
/// Four 16-bit numbers a texel, 0 … 65535 for 0 … 1: x = n_east / 2 + 1/2, y = n_north / 2 + 1/2,
/// z = height's share of the map's range, w = share of samples that are not void; x, y and z are
/// multiplied by w, so that averages of texels are averages over what is there.
struct ReliefMap {
    std::size_t columns =
        0; // texel (i, j) covers the samples [i · step, (i + 1) · step) × likewise
    std::size_t rows = 0;
    std::size_t step = 1;
    bool has_voids = false;
    double exaggeration = 1.0; // that normals are for
    std::vector<std::uint16_t> texels;
};

struct ReliefOptions {
    std::size_t side_max = 4096; // texels along a side, >= 2
    /// Normals are kept for heights stretched so much: near the one that is drawn, 16 bits are
    /// enough for slopes of any size, also of degrees against metres.
    double exaggeration = 1.0;
};

/// The finest relief map within the options: blocks of step × step samples are averaged. Only
/// Cancelled can go wrong.
Result<ReliefMap> makeReliefMap(const Heightfield& heightfield,
                                const SceneFrame& frame,
                                const ReliefOptions& options,
                                JobMonitor& monitor);

} // namespace marsview
