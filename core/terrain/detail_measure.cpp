// Notation: a cell of level k has its upper left sample at (X, Y) and is W columns wide and H rows
// high (2^k, fewer at the border), u = (x - X) / W and v = (y - Y) / H. Over its triangles
//
//   upper, u >= v:  z = z00 + u (z10 - z00) + v (z11 - z10)
//   lower, u <= v:  z = z00 + v (z01 - z00) + u (z11 - z01)
//
// so along a row of samples only v varies, and one multiplication per sample and level remains. A
// column belongs to the cell to its right, the map's last one to the last cell, regardless of the
// parts.

#include "core/terrain/detail_measure.h"

#include "core/base/check.h"
#include "core/base/float_rounding.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kNodeCells = DetailErrors::kNodeCells;

// The error in units of the root mean square. Measured on maps of the Moon, Mars and the Earth at
// exaggerations 1 to 20: 99 % of the pixels of a picture are then within the requested error.
constexpr float kDeviations = 1.25F;

// Columns processed at a time: few enough for their 33 rows to stay in the L1 cache.
constexpr std::size_t kStripCells = 256;

constexpr std::size_t kSparseStep = std::size_t{1} << DetailMeasure::kSparseLevel;
static_assert(kSparseStep == 2 * kNodeCells, "finer cells lie within a node");

} // namespace

// The errors of each level on some nodes of a row of level-0 nodes.
class DetailMeasure::Worker::Strip {
public:
    explicit Strip(const DetailMeasure& measure)
        : measure_(measure)
        , maxima_(kStripCells + 1)
        , squares_(kStripCells + 1)
        , u_(kStripCells + 1)
        , upper_(kStripCells + 1)
        , upper_per_v_(kStripCells + 1)
        , lower_(kStripCells + 1)
        , lower_per_v_(kStripCells + 1)
        , counts_(kStripCells / kNodeCells)
    {}

    // The strip of a part with `cells` columns of cells from `column` on, and `row_count` samples
    // high from `row` on.
    void place(const DetailPart& part,
               std::size_t column,
               std::size_t cells,
               std::size_t row,
               std::size_t row_count)
    {
        stride_ = part.columns;
        const std::size_t offset = row * part.columns + column;
        heights_ = part.heights + offset;
        drawn_ = (part.drawn != nullptr ? part.drawn : part.heights) + offset;
        has_gaps_ = part.drawn != nullptr;
        first_column_ = part.first_column + column;
        first_row_ = part.first_row + row;
        columns_ = cells + 1;
        row_count_ = row_count;
        countSamples();
    }

    std::size_t nodeCount() const { return (columns_ - 2) / kNodeCells + 1; }

    // Writes the error of a level within each node.
    void measure(std::size_t level, float* errors)
    {
        std::fill(maxima_.begin(), maxima_.end(), 0.0F);
        std::fill(squares_.begin(), squares_.end(), 0.0F);
        compareLevel(std::size_t{1} << level);
        const std::size_t last = columns_ - 1;
        for (std::size_t begin = 0, node = 0; begin < last; begin += kNodeCells, ++node) {
            const std::size_t end = std::min(begin + kNodeCells, last);
            float largest = 0.0F;
            float sum = 0.0F;
            for (std::size_t column = begin; column <= end; ++column) {
                largest = std::max(largest, maxima_[column]);
                sum += squares_[column];
            }
            const float mean = counts_[node] > 0.0F ? sum / counts_[node] : 0.0F;
            errors[node] = std::max(largest / DetailErrors::kPeak, kDeviations * std::sqrt(mean));
        }
    }

private:
    // Counts the valid samples of each node.
    void countSamples()
    {
        const std::size_t last = columns_ - 1;
        for (std::size_t begin = 0, node = 0; begin < last; begin += kNodeCells, ++node) {
            const std::size_t end = std::min(begin + kNodeCells, last);
            std::size_t count = (end + 1 - begin) * row_count_;
            for (std::size_t i = 0; i < (has_gaps_ ? row_count_ : 0); ++i) {
                const float* row = heights_ + i * stride_;
                count -= static_cast<std::size_t>(std::count_if(
                    row + begin, row + end + 1, [](float height) { return std::isnan(height); }));
            }
            counts_[node] = static_cast<float>(count);
        }
    }

    void compareLevel(std::size_t step)
    {
        const std::size_t last_row = measure_.rows_ - 1;
        const std::size_t end_row = first_row_ + row_count_ - 1;
        for (std::size_t begin = first_row_ / step * step; begin < end_row; begin += step) {
            const std::size_t end = std::min(begin + step, last_row);
            if (step <= kNodeCells) {
                // Only the first column of the cell to the right of the strip is needed; its right
                // side has no weight there.
                const auto heights_of = [this](std::size_t row) {
                    const float* heights = drawn_ + (row - first_row_) * stride_;
                    return [this, heights](std::size_t column) {
                        return heights[std::min(column - first_column_, columns_ - 1)];
                    };
                };
                setCells(step, heights_of(begin), heights_of(end));
            } else {
                const auto heights_of = [this](std::size_t row) {
                    const std::size_t sparse_row = (row + kSparseStep - 1) / kSparseStep;
                    const float* heights =
                        measure_.sparse_.data() + sparse_row * measure_.sparse_columns_;
                    return [heights](std::size_t column) {
                        return heights[(column + kSparseStep - 1) / kSparseStep];
                    };
                };
                setCells(step, heights_of(begin), heights_of(end));
            }
            const std::size_t from = std::max(begin, first_row_);
            // The cells' last row is the next ones' first, and counts once.
            const std::size_t to = end < end_row ? end : end_row + 1;
            for (std::size_t row = from; row < to; ++row) {
                compareRow(static_cast<float>(row - begin) / static_cast<float>(end - begin),
                           heights_ + (row - first_row_) * stride_);
            }
        }
    }

    // The surface drawn along one row of cells, as functions of v. `above` and `below` give the
    // heights of the vertices along the cells' upper and lower sides, by the map's columns.
    template <typename Above, typename Below>
    void setCells(std::size_t step, const Above& above, const Below& below)
    {
        const std::size_t last = measure_.columns_ - 1;
        const std::size_t last_column = first_column_ + columns_ - 1;
        for (std::size_t begin = first_column_ / step * step; begin <= last_column && begin < last;
             begin += step) {
            const std::size_t end = std::min(begin + step, last);
            const float z00 = above(begin);
            const float z01 = below(begin);
            const float z10 = above(end);
            const float z11 = below(end);
            const float per_column = 1.0F / static_cast<float>(end - begin);
            const std::size_t from = std::max(begin, first_column_);
            // The map's last column is the right side of the last cell.
            const std::size_t to = std::min(end == last ? last : end - 1, last_column);
            for (std::size_t column = from; column <= to; ++column) {
                const float share = static_cast<float>(column - begin) * per_column;
                const std::size_t i = column - first_column_;
                u_[i] = share;
                upper_[i] = z00 + share * (z10 - z00);
                upper_per_v_[i] = z11 - z10;
                lower_[i] = z00 + share * (z11 - z01);
                lower_per_v_[i] = z01 - z00;
            }
        }
    }

    // Adds the distances of a row of samples at v. Void samples, NaN, change nothing.
    void compareRow(float v, const float* samples)
    {
        for (std::size_t i = 0; i < columns_; ++i) {
            const float z_upper = upper_[i] + v * upper_per_v_[i];
            const float z_lower = lower_[i] + v * lower_per_v_[i];
            const float error = std::abs(samples[i] - (u_[i] >= v ? z_upper : z_lower));
            maxima_[i] = error > maxima_[i] ? error : maxima_[i];
            const float square = error * error;
            squares_[i] += square >= 0.0F ? square : 0.0F;
        }
    }

    const DetailMeasure& measure_;
    std::vector<float> maxima_; // of one level, by column
    std::vector<float> squares_;
    std::vector<float> u_;     // of one row of cells, by column
    std::vector<float> upper_; // at v = 0
    std::vector<float> upper_per_v_;
    std::vector<float> lower_;
    std::vector<float> lower_per_v_;
    std::vector<float> counts_; // of samples that are not void, by node
    const float* heights_ = nullptr;
    const float* drawn_ = nullptr;
    bool has_gaps_ = false;
    std::size_t stride_ = 0;
    std::size_t first_column_ = 0;
    std::size_t first_row_ = 0;
    std::size_t columns_ = 0; // of samples
    std::size_t row_count_ = 0;
};

DetailMeasure::Worker::Worker(DetailMeasure& measure)
    : measure_(&measure)
    , strip_(std::make_unique<Strip>(measure))
{}

DetailMeasure::Worker::~Worker() = default;
DetailMeasure::Worker::Worker(Worker&&) noexcept = default;
DetailMeasure::Worker& DetailMeasure::Worker::operator=(Worker&&) noexcept = default;

void DetailMeasure::Worker::measure(const DetailPart& part)
{
    MARSVIEW_CHECK(part.first_column % kNodeCells == 0 && part.first_row % kNodeCells == 0 &&
                   part.columns > 1 && part.rows > 1);
    const std::size_t levels = measure_->errors_.size();
    const std::size_t nodes = (part.columns - 2) / kNodeCells + 1;
    errors_.resize(levels * nodes);
    for (std::size_t row = 0; row < part.rows - 1; row += kNodeCells) {
        const std::size_t row_count = std::min(kNodeCells, part.rows - 1 - row) + 1;
        for (std::size_t column = 0; column < part.columns - 1; column += kStripCells) {
            const std::size_t cells = std::min(kStripCells, part.columns - 1 - column);
            strip_->place(part, column, cells, row, row_count);
            for (std::size_t level = 1; level < levels; ++level) {
                strip_->measure(level, errors_.data() + level * nodes + column / kNodeCells);
            }
        }
        measure_->include((part.first_row + row) / kNodeCells, part.first_column / kNodeCells,
                          nodes, errors_);
    }
}

DetailMeasure::DetailMeasure(std::size_t columns,
                             std::size_t rows,
                             LargeVector<float> sparse,
                             const SampleRows& measured)
    : columns_(columns)
    , rows_(rows)
    , sparse_(std::move(sparse))
    , sparse_columns_((columns - 1 + kSparseStep - 1) / kSparseStep + 1)
    , errors_(DetailErrors::errorsToBeFilled(columns, rows))
{
    MARSVIEW_CHECK(sparse_.size() ==
                   sparse_columns_ * ((rows - 1 + kSparseStep - 1) / kSparseStep + 1));
    for (std::size_t level = 1; level < errors_.size(); ++level) {
        DetailErrors::NodeLevel& nodes = errors_[level];
        const std::size_t end_row = std::min(measured.end, rows);
        if (measured.first >= end_row) {
            continue;
        }
        const std::size_t end = std::min(((end_row - 1) / kNodeCells >> level) + 1, nodes.rows);
        const std::size_t first = std::min((measured.first / kNodeCells) >> level, end);
        std::fill(nodes.errors_m.begin() + static_cast<std::ptrdiff_t>(first * nodes.columns),
                  nodes.errors_m.begin() + static_cast<std::ptrdiff_t>(end * nodes.columns), 0.0F);
    }
}

void DetailMeasure::include(std::size_t node_row,
                            std::size_t first_node,
                            std::size_t node_count,
                            const std::vector<float>& errors)
{
    const std::lock_guard lock(mutex_);
    for (std::size_t level = 1; level < errors_.size(); ++level) {
        DetailErrors::NodeLevel& nodes = errors_[level];
        float* row = nodes.errors_m.data() + (node_row >> level) * nodes.columns;
        for (std::size_t i = 0; i < node_count; ++i) {
            float& error = row[(first_node + i) >> level];
            error = std::max(error, roundedUpShort(errors[level * node_count + i]));
        }
    }
}

DetailErrors DetailMeasure::finish() &&
{
    return DetailErrors::from(std::move(errors_));
}

} // namespace marsview
