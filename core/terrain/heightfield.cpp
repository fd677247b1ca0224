#include "core/terrain/heightfield.h"

#include "core/base/check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace marsview {
namespace {

// The cell of a position, and the position in it.
struct CellPlace {
    std::size_t column = 0;
    std::size_t row = 0;
    double u = 0.0;
    double v = 0.0;
};

// Empty outside the outermost samples.
std::optional<CellPlace> cellPlace(GridPoint grid, std::size_t columns, std::size_t rows)
{
    const double last_column = static_cast<double>(columns - 1);
    const double last_row = static_cast<double>(rows - 1);
    if (!(grid.column >= 0.0 && grid.column <= last_column && grid.row >= 0.0 &&
          grid.row <= last_row)) {
        return std::nullopt;
    }
    // The last sample belongs to the last cell.
    const double c = std::min(std::floor(grid.column), last_column - 1.0);
    const double r = std::min(std::floor(grid.row), last_row - 1.0);
    return CellPlace{static_cast<std::size_t>(c), static_cast<std::size_t>(r), grid.column - c,
                     grid.row - r};
}

double heightBy(TileCursor& cursor, const CellPlace& at)
{
    const CellHeights cell{cursor.sample(at.column, at.row), cursor.sample(at.column + 1, at.row),
                           cursor.sample(at.column, at.row + 1),
                           cursor.sample(at.column + 1, at.row + 1)};
    return heightInCell(cell, at.u, at.v);
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

} // namespace

std::optional<HeightRange> heightRange(const SampleStatistics& statistics,
                                       const ElevationScale& scale)
{
    if (!statistics.hasSamples()) {
        return std::nullopt;
    }
    const double a = scale.height(statistics.raw_minimum);
    const double b = scale.height(statistics.raw_maximum);
    return HeightRange{std::min(a, b), std::max(a, b)}; // a negative gain swaps them
}

Heightfield::Heightfield(std::shared_ptr<const SampleGrid> samples,
                         const SampleStatistics& statistics,
                         const ElevationScale& scale)
    : samples_(std::move(samples))
    , scale_(scale)
    , range_(heightRange(statistics, scale))
{
    MARSVIEW_CHECK(samples_ && samples_->columns() >= 2 && samples_->rows() >= 2);
}

Heightfield::Heightfield(std::shared_ptr<const TiledSamples> tiles,
                         const SampleStatistics& statistics,
                         const ElevationScale& scale)
    : tiles_(std::move(tiles))
    , scale_(scale)
    , range_(heightRange(statistics, scale))
{
    MARSVIEW_CHECK(tiles_ && tiles_->layout().columns >= 2 && tiles_->layout().rows >= 2);
}

double Heightfield::heightNow(GridPoint grid) const
{
    const std::optional<CellPlace> at = cellPlace(grid, columns(), rows());
    if (!at) {
        return kNan;
    }
    if (!isTiled()) {
        return heightInCell(cell(at->column, at->row), at->u, at->v);
    }
    TileCursor cursor(*tiles_, scale_, TileAccess::Resident);
    return heightBy(cursor, *at);
}

double Heightfield::height(GridPoint grid) const
{
    const std::optional<CellPlace> at = cellPlace(grid, columns(), rows());
    if (!at) {
        return kNan;
    }
    if (!isTiled()) {
        return heightInCell(cell(at->column, at->row), at->u, at->v);
    }
    TileCursor cursor(*tiles_, scale_, TileAccess::Resident);
    const double height_m = heightBy(cursor, *at);
    if (!cursor.isExact()) {
        tiles_->ask(at->column + 1, at->row + 1);
        tiles_->ask(at->column, at->row);
    }
    return height_m;
}

bool Heightfield::isExact(GridPoint grid) const
{
    const std::optional<CellPlace> at = cellPlace(grid, columns(), rows());
    if (!at || !isTiled()) {
        return true;
    }
    TileCursor cursor(*tiles_, scale_, TileAccess::Resident);
    heightBy(cursor, *at);
    return cursor.isExact();
}

double Heightfield::heightWaiting(GridPoint grid) const
{
    const std::optional<CellPlace> at = cellPlace(grid, columns(), rows());
    if (!at) {
        return kNan;
    }
    if (!isTiled()) {
        return heightInCell(cell(at->column, at->row), at->u, at->v);
    }
    TileCursor cursor(*tiles_, scale_, TileAccess::Wait);
    return heightBy(cursor, *at);
}

double Heightfield::tiledSample(std::size_t column, std::size_t row) const
{
    return TileCursor(*tiles_, scale_, TileAccess::Resident).sample(column, row);
}

} // namespace marsview
