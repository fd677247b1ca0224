#include "core/body/body_grid.h"

#include "core/terrain/detail_errors.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

// Bounds are measured at so many columns and rows, and raised by what may lie between them.
constexpr std::size_t kMeasuredSide = 33;
constexpr double kBoundMargin = 1.02;

} // namespace

Result<std::shared_ptr<const BodyGrid>> BodyGrid::make(const Georeference& georeference,
                                                       JobMonitor& monitor,
                                                       const std::optional<Ellipsoid>& scene)
{
    Result<BodyPositions> positions = BodyPositions::make(georeference, monitor, scene);
    if (!positions) {
        return std::move(positions).error();
    }
    return std::shared_ptr<const BodyGrid>(
        new BodyGrid(std::move(positions).value(), georeference));
}

BodyGrid::BodyGrid(BodyPositions positions, const Georeference& georeference)
    : positions_(std::move(positions))
    , columns_(georeference.columns())
    , rows_(georeference.rows())
{
    repeats_first_ = positions_.wraps() && positions_.columns() == columns_;
    if (repeats_first_ && (columns_ - 1) % DetailErrors::kNodeCells != 0) {
        ++columns_;
    }
    const auto pole_next_to = [&](std::size_t row) {
        return positions_.at(0, row, 0.0).z > 0.0 ? Pole::North : Pole::South;
    };
    if (positions_.closesAtFirstRow() || isPole(0)) {
        first_pole_ = pole_next_to(0);
    }
    if (positions_.closesAtLastRow() || isPole(rows_ - 1)) {
        last_pole_ = pole_next_to(positions_.rows() - 1);
    }
    measure();
}

// The index in the positions of a row, or of the nearest one off a pole.
std::size_t BodyGrid::offPole(std::size_t row) const noexcept
{
    const std::size_t first = positions_.firstRow();
    return row < first ? 0 : std::min(row - first, positions_.rows() - 1);
}

Vec3 BodyGrid::at(std::size_t column, std::size_t row, double height_m) const noexcept
{
    if (isPole(row)) {
        return atPole(row == 0 ? first_pole_ : last_pole_, height_m);
    }
    return positions_.at(placeOf(column), row - positions_.firstRow(), height_m);
}

Vec3 BodyGrid::atPole(Pole pole, double height_m) const noexcept
{
    const double z = ellipsoid().polar_m + height_m;
    return {0.0, 0.0, pole == Pole::South ? -z : z};
}

Vec3 BodyGrid::normal(std::size_t column, std::size_t row) const noexcept
{
    return normalized(at(column, row, 1.0) - at(column, row, 0.0));
}

BodyGrid::Steps BodyGrid::steps(std::size_t column, std::size_t row) const noexcept
{
    const std::size_t count = positions_.columns();
    const std::size_t c = placeOf(column);
    const std::size_t r = offPole(row);
    const auto across = [&](std::size_t before, std::size_t after, double cells) {
        return (positions_.at(after, r, 0.0) - positions_.at(before, r, 0.0)) * (1.0 / cells);
    };
    Steps steps;
    if (positions_.wraps()) {
        steps.column = across(c == 0 ? count - 1 : c - 1, c + 1 == count ? 0 : c + 1, 2.0);
    } else {
        const std::size_t before = c == 0 ? 0 : c - 1;
        const std::size_t after = std::min(c + 1, count - 1);
        steps.column = across(before, after, static_cast<double>(after - before));
    }
    const std::size_t above = r == 0 ? 0 : r - 1;
    const std::size_t below = std::min(r + 1, positions_.rows() - 1);
    steps.row = (positions_.at(c, below, 0.0) - positions_.at(c, above, 0.0)) *
                (1.0 / static_cast<double>(below - above));
    return steps;
}

// The distance of a triangle from a surface is at most an eighth of the second derivatives along
// its sides. They are taken from differences over many samples: those between neighbors of a fine
// raster are rounding errors.
void BodyGrid::measure()
{
    const std::size_t last_column = positions_.columns() - 1;
    const std::size_t last_row = positions_.rows() - 1;
    const std::size_t step = std::max<std::size_t>(
        1, std::min({last_column / 4, last_row / 4, std::max(last_column, last_row) / 64}));
    const double square = static_cast<double>(step * step);
    const auto place = [](std::size_t i, std::size_t first, std::size_t last) {
        return first + i * (last - first) / (kMeasuredSide - 1);
    };
    const auto foot = [&](std::size_t column, std::size_t row) {
        return positions_.at(column, row, 0.0);
    };
    double second_max = 0.0;
    for (std::size_t j = 0; j < kMeasuredSide; ++j) {
        for (std::size_t i = 0; i < kMeasuredSide; ++i) {
            const Steps here =
                steps(place(i, 0, last_column), place(j, 0, last_row) + positions_.firstRow());
            column_step_max_m_ = std::max(column_step_max_m_, length(here.column));
            row_step_max_m_ = std::max(row_step_max_m_, length(here.row));
            skew_max_ = std::max(skew_max_, std::abs(dot(here.column, here.row)) /
                                                (length(here.column) * length(here.row)));
            if (last_column < 2 * step || last_row < 2 * step) {
                continue;
            }
            const std::size_t c = place(i, step, last_column - step);
            const std::size_t r = place(j, step, last_row - step);
            const Vec3 middle = foot(c, r) * 2.0;
            const auto second = [&](const Vec3& before, const Vec3& after) {
                return length(before + after - middle) / square;
            };
            second_max =
                std::max({second_max, second(foot(c - step, r - step), foot(c + step, r + step)),
                          second(foot(c - step, r), foot(c + step, r)) +
                              second(foot(c, r - step), foot(c, r + step))});
        }
    }
    if (second_max == 0.0) { // too few samples for differences
        const double side = std::max(column_step_max_m_, row_step_max_m_);
        second_max = 2.0 * side * side / std::min(ellipsoid().polar_m, ellipsoid().equatorial_m);
    }
    column_step_max_m_ *= kBoundMargin;
    row_step_max_m_ *= kBoundMargin;
    sag_per_square_m_ = kBoundMargin * second_max / 8.0;
}

} // namespace marsview
