// The error of the surface drawn with fewer samples.
//
// Detail comes in levels: level k takes every 2^k-th sample of every 2^k-th row, and the last
// column and row, and divides its cells by the same diagonal (triangulation.h). Nodes are those of
// MinMaxPyramid: node (k, i, j) covers kNodeCells × kNodeCells cells of level k.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/large_vector.h"
#include "core/base/result.h"
#include "core/terrain/drawn_surface.h"

#include <cstddef>
#include <span>
#include <vector>

namespace marsview {

/// A node of the quadtree over the map.
struct DetailNode {
    std::size_t level = 0;
    std::size_t column = 0; // counted in nodes of that level
    std::size_t row = 0;
    bool operator==(const DetailNode&) const = default;
};

/// Values at the corners of the nodes of one level.
struct CornerGrid {
    std::size_t columns = 0; // of nodes; there is one corner more
    std::size_t rows = 0;
    LargeVector<float> values;
};

/// The measured error of each node. Immutable; any thread. Takes about 1/384 of a byte per sample.
class DetailErrors {
public:
    static constexpr std::size_t kNodeCells = 32;

    /// The error of a sample is at most kPeak times the error of its node.
    static constexpr float kPeak = 4.0F;

    /// The minimum growth factor of a corner's error from one level to the next. See cornerError.
    static constexpr float kGrowth = 1.5F;

    /// Compares every sample with every level, on all cores. The only error is Canceled.
    static Result<DetailErrors> build(const DrawnSurface& surface, JobMonitor& monitor);

    /// The errors of a level's nodes, row by row; those of level 0 are 0 and not stored.
    struct NodeLevel {
        std::size_t columns = 0;
        std::size_t rows = 0;
        LargeVector<float> errors_m;
    };
    using NodeErrors = std::vector<NodeLevel>; // by level
    /// For a map of columns × rows samples: 0 for every node.
    static NodeErrors noErrors(std::size_t columns, std::size_t rows);
    /// The same without values.
    static NodeErrors errorsToBeFilled(std::size_t columns, std::size_t rows);
    /// From measured errors, with the levels of noErrors(); the same bits as build().
    static DetailErrors from(NodeErrors errors);
    const NodeErrors& nodeErrors() const noexcept { return nodes_; }

    std::size_t levelCount() const noexcept { return nodes_.size(); }
    std::size_t columns(std::size_t level) const noexcept { return nodes_[level].columns; }
    std::size_t rows(std::size_t level) const noexcept { return nodes_[level].rows; }

    /// The error of the surface drawn at the node's level, in meters. Vertical distances are taken
    /// at the valid samples within each block of kNodeCells × kNodeCells cells of level 0,
    /// including its sides. A block's error is 1.25 times their root mean square, or 1/kPeak of the
    /// largest if that is more; the node's is that of its worst block, rounded up to 8 bits
    /// (roundedUpShort). Errors below 1e-6 of the map's range are rounding errors. 0 at level 0.
    float nodeError(const DetailNode& node) const noexcept
    {
        const NodeLevel& l = nodes_[node.level];
        return node.level == 0 ? 0.0F : l.errors_m[node.row * l.columns + node.column];
    }

    /// Bounds of the error at the corners of a level >= 1's nodes: columns + 1 times rows + 1 of
    /// them. A corner's bound is at least the errors of the nodes that meet there, so its
    /// interpolation between the corners of a node is at least the node's error. It is also at
    /// least kGrowth times the bounds of the finer level's corners in these nodes.
    float cornerError(std::size_t level, std::size_t column, std::size_t row) const noexcept
    {
        return corners_[level].values[row * (nodes_[level].columns + 1) + column];
    }

private:
    void spreadToCorners();

    NodeErrors nodes_;
    std::vector<CornerGrid> corners_; // by level >= 1
};

/// At every corner of columns × rows nodes, the largest value of the nodes that meet there.
CornerGrid largestAtCorners(std::size_t columns, std::size_t rows, std::span<const float> nodes);

/// Raises `coarser` to at least DetailErrors::kGrowth times the values of `finer`, the next finer
/// level, at all corners of the nodes that meet at a corner.
void growCorners(const CornerGrid& finer, CornerGrid& coarser);

} // namespace marsview
