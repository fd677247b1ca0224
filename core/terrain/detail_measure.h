// Measures the error of drawing with fewer samples, in parts.
#pragma once

#include "core/base/large_vector.h"
#include "core/terrain/detail_errors.h"

#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

namespace marsview {

/// A rectangle of samples: whole blocks of DetailErrors::kNodeCells × kNodeCells cells, including
/// their sides.
struct DetailPart {
    std::size_t first_column = 0; // of the map; multiples of kNodeCells
    std::size_t first_row = 0;
    std::size_t columns = 0; // of samples; one more than of cells
    std::size_t rows = 0;
    const float* heights = nullptr; // over the map's base; row by row; NaN for voids
    const float* drawn = nullptr;   // the same without gaps; null: no gaps
};

/// Rows of samples [first, end), from the first one of a node on; by default, all of a map.
struct SampleRows {
    std::size_t first = 0;
    std::size_t end = std::numeric_limits<std::size_t>::max();
};

/// Collects the errors of a map, whose parts arrive in any order and from any thread. The result
/// does not depend on the division into parts.
class DetailMeasure {
public:
    /// The level whose samples, with the last column and row, the caller must supply in advance.
    /// Levels coarser than a part take their vertices from there.
    static constexpr std::size_t kSparseLevel = 6;

    /// A map of columns × rows samples. `sparse` has the drawn heights of level kSparseLevel, over
    /// the map's base. If parts will only be in some rows, heights that are not vertices of cells
    /// there need not be set, and errors() are set for the nodes there.
    DetailMeasure(std::size_t columns,
                  std::size_t rows,
                  LargeVector<float> sparse,
                  const SampleRows& measured = {});

    /// Working memory of one measuring thread.
    class Worker {
    public:
        explicit Worker(DetailMeasure& measure);
        ~Worker();
        Worker(Worker&&) noexcept;
        Worker& operator=(Worker&&) noexcept;

        void measure(const DetailPart& part);

    private:
        class Strip;
        DetailMeasure* measure_;
        std::unique_ptr<Strip> strip_;
        std::vector<float> errors_; // of a row of nodes, level by level
    };

    /// Call when every part has been measured.
    DetailErrors finish() &&;

    /// The errors measured so far, for checkpoints: measuring continues from restored values. Do
    /// not call while a worker measures.
    const DetailErrors::NodeErrors& errors() const noexcept { return errors_; }
    DetailErrors::NodeErrors& errors() noexcept { return errors_; }

private:
    void include(std::size_t node_row,
                 std::size_t first_node,
                 std::size_t node_count,
                 const std::vector<float>& errors);

    std::size_t columns_;
    std::size_t rows_;
    LargeVector<float> sparse_;
    std::size_t sparse_columns_;
    DetailErrors::NodeErrors errors_;
    std::mutex mutex_; // guards errors_
};

} // namespace marsview
