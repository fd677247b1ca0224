// Measuring what drawing with fewer samples is off by, piece by piece.
#pragma once

#include "core/terrain/detail_errors.h"

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace marsview {

/// A rectangle of samples: whole blocks of DetailErrors::kNodeCells × kNodeCells cells, their sides
/// included.
struct DetailPart {
    std::size_t first_column = 0; // of the map; multiples of kNodeCells
    std::size_t first_row = 0;
    std::size_t columns = 0; // of samples; one more than of cells
    std::size_t rows = 0;
    const float* heights = nullptr; // over the map's base; row by row; NaN where void
    const float* drawn = nullptr;   // the same without gaps; null: there are none
};

/// Collects the errors of a map, whose parts come in any order and from any thread. The result does
/// not depend on how the map is cut.
class DetailMeasure {
public:
    /// Every how many-th sample of every how many-th row, and the last column and row, are asked of
    /// the caller beforehand. Levels that are coarser than a part take their vertices from there.
    static constexpr std::size_t kSparseLevel = 6;

    /// A map of columns × rows samples. `sparse` has the drawn heights of level kSparseLevel, over
    /// the map's base.
    DetailMeasure(std::size_t columns, std::size_t rows, std::vector<float> sparse);

    /// Memory of one thread that measures.
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

    /// Once every part was measured.
    DetailErrors finish() &&;

    /// What was measured so far, for checkpoints: measuring continues from values that are written
    /// back. Not while a worker measures.
    const DetailErrors::NodeErrors& errors() const noexcept { return errors_; }
    DetailErrors::NodeErrors& errors() noexcept { return errors_; }

private:
    void include(std::size_t node_row,
                 std::size_t first_node,
                 std::size_t node_count,
                 const std::vector<float>& errors);

    std::size_t columns_;
    std::size_t rows_;
    std::vector<float> sparse_;
    std::size_t sparse_columns_;
    DetailErrors::NodeErrors errors_;
    std::mutex mutex_; // of errors_
};

} // namespace marsview
