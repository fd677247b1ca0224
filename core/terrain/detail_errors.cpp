#include "core/terrain/detail_errors.h"

#include "core/base/parallel.h"
#include "core/terrain/detail_measure.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

// Rows of corners that a thread takes at once: all of a small map.
constexpr std::size_t kCornerRows = 128;

std::size_t nodeCount(std::size_t samples, std::size_t level)
{
    const std::size_t node_samples = DetailErrors::kNodeCells << level;
    return (samples - 1 + node_samples - 1) / node_samples;
}

// The drawn heights of the vertices of a level.
LargeVector<float> drawnVertices(const DrawnSurface& surface, std::size_t level)
{
    const std::size_t step = std::size_t{1} << level;
    const std::size_t last_column = surface.heightfield().columns() - 1;
    const std::size_t last_row = surface.heightfield().rows() - 1;
    LargeVector<float> heights;
    for (std::size_t row = 0; row < last_row + step; row += step) {
        for (std::size_t column = 0; column < last_column + step; column += step) {
            heights.push_back(
                surface.height(std::min(column, last_column), std::min(row, last_row)));
        }
    }
    return heights;
}

} // namespace

Result<DetailErrors> DetailErrors::build(const DrawnSurface& surface, JobMonitor& monitor)
{
    const std::size_t columns = surface.heightfield().columns();
    const std::size_t rows = surface.heightfield().rows();
    const bool has_voids = surface.heightfield().hasVoids();
    DetailMeasure measure(columns, rows, drawnVertices(surface, DetailMeasure::kSparseLevel));
    std::atomic<std::size_t> done{0};
    const std::size_t bands = nodeCount(rows, 0);
    parallelRanges(bands, 4, [&](std::size_t begin, std::size_t end) {
        DetailMeasure::Worker worker(measure);
        std::vector<float> heights((kNodeCells + 1) * columns);
        std::vector<float> drawn(has_voids ? heights.size() : 0);
        for (std::size_t band = begin; band < end && !monitor.isCanceled(); ++band) {
            const std::size_t first_row = band * kNodeCells;
            const std::size_t row_count = std::min(kNodeCells, rows - 1 - first_row) + 1;
            for (std::size_t i = 0; i < row_count; ++i) {
                const std::span<float> row(heights.data() + i * columns, columns);
                surface.read(0, first_row + i, row);
                for (std::size_t column = 0; has_voids && column < columns; ++column) {
                    drawn[i * columns + column] = std::isnan(row[column])
                                                      ? surface.filled(column, first_row + i)
                                                      : row[column];
                }
            }
            worker.measure({.first_column = 0,
                            .first_row = first_row,
                            .columns = columns,
                            .rows = row_count,
                            .heights = heights.data(),
                            .drawn = has_voids ? drawn.data() : nullptr});
            monitor.report(static_cast<double>(++done) / static_cast<double>(bands));
        }
    });
    if (monitor.isCanceled()) {
        return Error{ErrorCode::Canceled, "canceled"};
    }
    return std::move(measure).finish();
}

DetailErrors::NodeErrors DetailErrors::noErrors(std::size_t columns, std::size_t rows)
{
    NodeErrors levels = errorsToBeFilled(columns, rows);
    for (NodeLevel& level : levels) {
        std::fill(level.errors_m.begin(), level.errors_m.end(), 0.0F);
    }
    return levels;
}

DetailErrors::NodeErrors DetailErrors::errorsToBeFilled(std::size_t columns, std::size_t rows)
{
    NodeErrors levels;
    do {
        const std::size_t level = levels.size();
        NodeLevel nodes{
            .columns = nodeCount(columns, level), .rows = nodeCount(rows, level), .errors_m = {}};
        nodes.errors_m.resize(level == 0 ? 0 : nodes.columns * nodes.rows);
        levels.push_back(std::move(nodes));
    } while (levels.back().columns * levels.back().rows > 1);
    return levels;
}

DetailErrors DetailErrors::from(NodeErrors errors)
{
    DetailErrors detail;
    detail.nodes_ = std::move(errors);
    detail.spreadToCorners();
    return detail;
}

void DetailErrors::spreadToCorners()
{
    corners_.resize(nodes_.size());
    for (std::size_t k = 1; k < nodes_.size(); ++k) {
        const NodeLevel& level = nodes_[k];
        corners_[k] = largestAtCorners(level.columns, level.rows, level.errors_m);
        if (k > 1) {
            growCorners(corners_[k - 1], corners_[k]);
        }
    }
}

CornerGrid largestAtCorners(std::size_t columns, std::size_t rows, std::span<const float> nodes)
{
    CornerGrid corners{
        .columns = columns, .rows = rows, .values = LargeVector<float>((columns + 1) * (rows + 1))};
    parallelRanges(rows + 1, kCornerRows, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
            const float* above = nodes.data() + (std::max<std::size_t>(row, 1) - 1) * columns;
            const float* below = nodes.data() + std::min(row, rows - 1) * columns;
            float* value = corners.values.data() + row * (columns + 1);
            float left = std::max(above[0], below[0]);
            for (std::size_t column = 0; column < columns; ++column) {
                const float right = std::max(above[column], below[column]);
                *value++ = std::max(left, right);
                left = right;
            }
            *value = left;
        }
    });
    return corners;
}

void growCorners(const CornerGrid& finer, CornerGrid& coarser)
{
    parallelRanges(coarser.rows + 1, kCornerRows, [&](std::size_t begin, std::size_t end) {
        std::vector<float> largest(finer.columns + 1); // over the rows that a corner's nodes reach
        for (std::size_t row = begin; row < end; ++row) {
            // The nodes that meet at a corner reach two finer nodes from it to either side.
            const std::size_t upper = 2 * std::max<std::size_t>(row, 1) - 2;
            const std::size_t lower = std::min(2 * row + 2, finer.rows);
            std::fill(largest.begin(), largest.end(), 0.0F);
            for (std::size_t r = upper; r <= lower; ++r) {
                const float* values = finer.values.data() + r * (finer.columns + 1);
                for (std::size_t c = 0; c <= finer.columns; ++c) {
                    largest[c] = std::max(largest[c], values[c]);
                }
            }
            float* value = coarser.values.data() + row * (coarser.columns + 1);
            for (std::size_t column = 0; column <= coarser.columns; ++column) {
                const std::size_t left = 2 * std::max<std::size_t>(column, 1) - 2;
                const std::size_t right = std::min(2 * column + 2, finer.columns);
                const float near =
                    *std::max_element(largest.begin() + static_cast<std::ptrdiff_t>(left),
                                      largest.begin() + static_cast<std::ptrdiff_t>(right) + 1);
                value[column] = std::max(value[column], DetailErrors::kGrowth * near);
            }
        }
    });
}

} // namespace marsview
