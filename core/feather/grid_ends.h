// Where a map ends on its body: at the border of its grid, unless it goes on there.
#pragma once

#include "core/geo/georeference.h"

#include <cstddef>
#include <optional>

namespace marsview {

/// A map around its body has no border between its last and first column, and none at a pole that
/// it reaches.
struct GridEnds {
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::size_t period = 0; // columns in a turn of a map around its body; 0 for others
    /// The rows at which the surface ends; rows beyond them lie at a pole. Nothing where it does
    /// not end.
    std::optional<std::size_t> first_row{};
    std::optional<std::size_t> last_row{};

    bool isAtEnd(std::size_t column, std::size_t row) const noexcept
    {
        return (period == 0 && (column == 0 || column + 1 == columns)) ||
               (first_row && row <= *first_row) || (last_row && row >= *last_row);
    }
};

GridEnds gridEnds(const Georeference& georeference);

} // namespace marsview
