// Rectangles of samples.
#pragma once

#include <cstddef>

namespace marsview {

/// Columns and rows.
struct GridSize {
    std::size_t columns = 0;
    std::size_t rows = 0;
    bool operator==(const GridSize&) const = default;
};

/// A rectangle of samples: columns [column, column + columns), rows likewise.
struct GridWindow {
    std::size_t column = 0;
    std::size_t row = 0;
    std::size_t columns = 0;
    std::size_t rows = 0;
};

} // namespace marsview
