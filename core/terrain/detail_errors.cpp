// Notation: a cell of level k has its upper left sample at (X, Y) and is W columns wide and H rows
// high (2^k, less at the border), u = (x - X) / W and v = (y - Y) / H. Over its triangles
//
//   upper, u >= v:  z = z00 + u (z10 - z00) + v (z11 - z10)
//   lower, u <= v:  z = z00 + v (z01 - z00) + u (z11 - z01)
//
// so along a row of samples everything but v is fixed per column, and one multiplication a sample
// and level is left.

#include "core/terrain/detail_errors.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace marsview {
namespace {

// Root mean squares that count as the error. Measured on maps of the Moon, Mars and the Earth at
// exaggerations 1 to 20: 99 % of the pixels of a picture are then within what was asked for.
constexpr float kDeviations = 1.25F;

std::size_t nodeCount(std::size_t samples, std::size_t level)
{
    const std::size_t node_samples = DetailErrors::kNodeCells << level;
    return (samples - 1 + node_samples - 1) / node_samples;
}

// The surface drawn at one level along one row of its cells, as functions of v: one entry a column.
struct CellRow {
    std::vector<float> u;
    std::vector<float> upper; // at v = 0
    std::vector<float> upper_per_v;
    std::vector<float> lower;
    std::vector<float> lower_per_v;

    explicit CellRow(std::size_t columns)
        : u(columns)
        , upper(columns)
        , upper_per_v(columns)
        , lower(columns)
        , lower_per_v(columns)
    {}

    // `above` and `below` give the heights of the samples along the cells' upper and lower sides.
    template <typename Above, typename Below>
    void set(std::size_t step, const Above& above, const Below& below)
    {
        const std::size_t last = u.size() - 1;
        float z00 = above(0);
        float z01 = below(0);
        for (std::size_t begin = 0; begin < last; begin += step) {
            const std::size_t end = std::min(begin + step, last);
            const float z10 = above(end);
            const float z11 = below(end);
            const float per_column = 1.0F / static_cast<float>(end - begin);
            // The last column is the right side of the last cell.
            const std::size_t count = (end == last ? end + 1 : end) - begin;
            for (std::size_t i = 0; i < count; ++i) {
                const float share = static_cast<float>(i) * per_column;
                u[begin + i] = share;
                upper[begin + i] = z00 + share * (z10 - z00);
                upper_per_v[begin + i] = z11 - z10;
                lower[begin + i] = z00 + share * (z11 - z01);
                lower_per_v[begin + i] = z01 - z00;
            }
            z00 = z10;
            z01 = z11;
        }
    }

    // Adds the distances of a row of samples at v. Void samples, NaN, change nothing.
    void compare(float v, const float* samples, float* maxima, float* squares) const
    {
        for (std::size_t i = 0; i < u.size(); ++i) {
            const float z_upper = upper[i] + v * upper_per_v[i];
            const float z_lower = lower[i] + v * lower_per_v[i];
            const float error = std::abs(samples[i] - (u[i] >= v ? z_upper : z_lower));
            maxima[i] = error > maxima[i] ? error : maxima[i];
            const float square = error * error;
            squares[i] += square >= 0.0F ? square : 0.0F;
        }
    }
};

// One row of level-0 nodes: its samples, and how far each level is from them.
class Band {
public:
    Band(const DrawnSurface& surface, std::size_t level_count)
        : surface_(surface)
        , columns_(surface.heightfield().columns())
        , level_count_(level_count)
        , samples_((DetailErrors::kNodeCells + 1) * columns_)
        , maxima_(columns_)
        , squares_(columns_)
        , counts_((columns_ - 2) / DetailErrors::kNodeCells + 1)
        , cells_(columns_)
    {
        if (surface.heightfield().samples().hasVoids()) {
            drawn_.resize(samples_.size());
        }
    }

    // Writes the error of level 1, 2, … within each node of the row into errors[level][node].
    void measure(std::size_t node_row, const std::vector<float*>& errors)
    {
        first_row_ = node_row * DetailErrors::kNodeCells;
        row_count_ =
            std::min(DetailErrors::kNodeCells, surface_.heightfield().rows() - 1 - first_row_) + 1;
        readSamples();
        countSamples();
        for (std::size_t level = 1; level < level_count_; ++level) {
            std::fill(maxima_.begin(), maxima_.end(), 0.0F);
            std::fill(squares_.begin(), squares_.end(), 0.0F);
            compareLevel(std::size_t{1} << level);
            const std::size_t last = columns_ - 1;
            for (std::size_t begin = 0, node = 0; begin < last;
                 begin += DetailErrors::kNodeCells, ++node) {
                const std::size_t end = std::min(begin + DetailErrors::kNodeCells, last);
                float largest = 0.0F;
                float sum = 0.0F;
                for (std::size_t column = begin; column <= end; ++column) {
                    largest = std::max(largest, maxima_[column]);
                    sum += squares_[column];
                }
                const float mean = counts_[node] > 0.0F ? sum / counts_[node] : 0.0F;
                errors[level][node] =
                    std::max(largest / DetailErrors::kPeak, kDeviations * std::sqrt(mean));
            }
        }
    }

private:
    void readSamples()
    {
        for (std::size_t i = 0; i < row_count_; ++i) {
            const std::span<float> row(samples_.data() + i * columns_, columns_);
            surface_.read(0, first_row_ + i, row);
            if (drawn_.empty()) {
                continue;
            }
            float* drawn = drawn_.data() + i * columns_;
            for (std::size_t column = 0; column < columns_; ++column) {
                drawn[column] =
                    std::isnan(row[column]) ? surface_.filled(column, first_row_ + i) : row[column];
            }
        }
    }

    // The samples of each node that are not void.
    void countSamples()
    {
        const std::size_t last = columns_ - 1;
        for (std::size_t begin = 0, node = 0; begin < last;
             begin += DetailErrors::kNodeCells, ++node) {
            const std::size_t end = std::min(begin + DetailErrors::kNodeCells, last);
            std::size_t count = (end + 1 - begin) * row_count_;
            for (std::size_t i = 0; i < (drawn_.empty() ? 0 : row_count_); ++i) {
                const float* row = samples_.data() + i * columns_;
                count -= static_cast<std::size_t>(std::count_if(
                    row + begin, row + end + 1, [](float height) { return std::isnan(height); }));
            }
            counts_[node] = static_cast<float>(count);
        }
    }

    void compareLevel(std::size_t step)
    {
        const std::size_t last_row = surface_.heightfield().rows() - 1;
        const std::size_t end_row = first_row_ + row_count_ - 1;
        const float* drawn = (drawn_.empty() ? samples_ : drawn_).data();
        for (std::size_t begin = first_row_ / step * step; begin < end_row; begin += step) {
            const std::size_t end = std::min(begin + step, last_row);
            if (step <= DetailErrors::kNodeCells) {
                const float* above = drawn + (begin - first_row_) * columns_;
                const float* below = drawn + (end - first_row_) * columns_;
                cells_.set(
                    step, [above](std::size_t column) { return above[column]; },
                    [below](std::size_t column) { return below[column]; });
            } else {
                cells_.set(
                    step, [&](std::size_t column) { return surface_.height(column, begin); },
                    [&](std::size_t column) { return surface_.height(column, end); });
            }
            const std::size_t from = std::max(begin, first_row_);
            // The cells' last row is the next ones' first, and counts once.
            const std::size_t to = end < end_row ? end : end_row + 1;
            for (std::size_t row = from; row < to; ++row) {
                cells_.compare(static_cast<float>(row - begin) / static_cast<float>(end - begin),
                               samples_.data() + (row - first_row_) * columns_, maxima_.data(),
                               squares_.data());
            }
        }
    }

    const DrawnSurface& surface_;
    std::size_t columns_;
    std::size_t level_count_;
    std::vector<float> samples_; // NaN where void
    std::vector<float> drawn_;   // without gaps; empty where there are none
    std::vector<float> maxima_;  // of one level, by column
    std::vector<float> squares_;
    std::vector<float> counts_; // of samples that are not void, by node
    CellRow cells_;
    std::size_t first_row_ = 0;
    std::size_t row_count_ = 0;
};

} // namespace

Result<DetailErrors> DetailErrors::build(const DrawnSurface& surface, JobMonitor& monitor)
{
    const std::size_t columns = surface.heightfield().columns();
    const std::size_t rows = surface.heightfield().rows();
    DetailErrors detail;
    do {
        const std::size_t level = detail.levels_.size();
        Level nodes{.columns = nodeCount(columns, level),
                    .rows = nodeCount(rows, level),
                    .errors_m = {},
                    .corner_errors_m = {}};
        nodes.errors_m.resize(nodes.columns * nodes.rows);
        detail.levels_.push_back(std::move(nodes));
    } while (detail.levels_.back().errors_m.size() > 1);

    // What each level is off by within each node of level 0.
    const Level& finest = detail.levels_.front();
    std::vector<std::vector<float>> errors(detail.levels_.size());
    for (std::size_t level = 1; level < errors.size(); ++level) {
        errors[level].resize(finest.errors_m.size());
    }
    std::atomic<std::size_t> done{0};
    parallelRanges(finest.rows, 4, [&](std::size_t begin, std::size_t end) {
        thread_local std::vector<float*> rows_of_levels;
        Band band(surface, errors.size());
        rows_of_levels.resize(errors.size());
        for (std::size_t row = begin; row < end && !monitor.isCancelled(); ++row) {
            for (std::size_t level = 1; level < errors.size(); ++level) {
                rows_of_levels[level] = errors[level].data() + row * finest.columns;
            }
            band.measure(row, rows_of_levels);
            monitor.report(static_cast<double>(++done) / static_cast<double>(finest.rows));
        }
    });
    if (monitor.isCancelled()) {
        return Error{ErrorCode::Cancelled, "cancelled"};
    }
    for (std::size_t level = 1; level < errors.size(); ++level) {
        Level& nodes = detail.levels_[level];
        for (std::size_t row = 0; row < finest.rows; ++row) {
            for (std::size_t column = 0; column < finest.columns; ++column) {
                float& error = nodes.errors_m[(row >> level) * nodes.columns + (column >> level)];
                error = std::max(error, errors[level][row * finest.columns + column]);
            }
        }
    }
    detail.spreadToCorners();
    return detail;
}

void DetailErrors::spreadToCorners()
{
    CornerGrid finer;
    for (std::size_t k = 1; k < levels_.size(); ++k) {
        Level& level = levels_[k];
        CornerGrid corners{.columns = level.columns,
                           .rows = level.rows,
                           .values = std::vector<float>((level.columns + 1) * (level.rows + 1))};
        for (std::size_t row = 0; row < level.rows; ++row) {
            for (std::size_t column = 0; column < level.columns; ++column) {
                const float error = level.errors_m[row * level.columns + column];
                for (const std::size_t corner : {row * (level.columns + 1) + column,
                                                 (row + 1) * (level.columns + 1) + column}) {
                    corners.values[corner] = std::max(corners.values[corner], error);
                    corners.values[corner + 1] = std::max(corners.values[corner + 1], error);
                }
            }
        }
        if (k > 1) {
            growCorners(finer, corners);
        }
        level.corner_errors_m = corners.values;
        finer = std::move(corners);
    }
}

void growCorners(const CornerGrid& finer, CornerGrid& coarser)
{
    for (std::size_t row = 0; row <= coarser.rows; ++row) {
        for (std::size_t column = 0; column <= coarser.columns; ++column) {
            // The nodes that meet at a corner reach two finer nodes from it to either side.
            const std::size_t left = 2 * std::max<std::size_t>(column, 1) - 2;
            const std::size_t upper = 2 * std::max<std::size_t>(row, 1) - 2;
            float largest = 0.0F;
            for (std::size_t r = upper; r <= std::min(2 * row + 2, finer.rows); ++r) {
                for (std::size_t c = left; c <= std::min(2 * column + 2, finer.columns); ++c) {
                    largest = std::max(largest, finer.values[r * (finer.columns + 1) + c]);
                }
            }
            float& value = coarser.values[row * (coarser.columns + 1) + column];
            value = std::max(value, DetailErrors::kGrowth * largest);
        }
    }
}

} // namespace marsview
