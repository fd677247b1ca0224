#include "core/terrain/heightfield.h"

#include "core/base/check.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace marsview {

Heightfield::Heightfield(std::shared_ptr<const SampleGrid> samples,
                         const SampleStatistics& statistics,
                         const ElevationScale& scale)
    : samples_(std::move(samples))
    , scale_(scale)
{
    MARSVIEW_CHECK(samples_ && samples_->columns() >= 2 && samples_->rows() >= 2);
    if (statistics.hasSamples()) {
        const double a = scale_.height(statistics.raw_minimum);
        const double b = scale_.height(statistics.raw_maximum);
        range_ = HeightRange{std::min(a, b), std::max(a, b)}; // a negative gain swaps them
    }
}

double Heightfield::height(GridPoint grid) const noexcept
{
    const double last_column = static_cast<double>(columns() - 1);
    const double last_row = static_cast<double>(rows() - 1);
    if (!(grid.column >= 0.0 && grid.column <= last_column && grid.row >= 0.0 &&
          grid.row <= last_row)) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    // The last sample belongs to the last cell.
    const double c = std::min(std::floor(grid.column), last_column - 1.0);
    const double r = std::min(std::floor(grid.row), last_row - 1.0);
    return heightInCell(cell(static_cast<std::size_t>(c), static_cast<std::size_t>(r)),
                        grid.column - c, grid.row - r);
}

} // namespace marsview
