// The samples of a raster on its body, closed to a surface: what is drawn of a map.
#pragma once

#include "core/body/body_positions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>

namespace marsview {

/// The raster's samples by their columns and rows. Where the raster goes around the body, the last
/// column repeats the first one: the raster's own if it has one, or else one more. Rasters of 32 n
/// + 1 columns leave out their last one instead, because a node of the quadtree has no room for one
/// more. Rows that lie at a pole are single points. Immutable; any thread.
class BodyGrid {
public:
    enum class Pole { None, North, South };

    /// Steps along the ellipsoid to the next column and row, in meters.
    struct Steps {
        Vec3 column;
        Vec3 row;
    };

    /// As BodyPositions::make().
    static Result<std::shared_ptr<const BodyGrid>>
    make(const Georeference& georeference,
         JobMonitor& monitor,
         const std::optional<Ellipsoid>& scene = std::nullopt);

    std::size_t columns() const noexcept { return columns_; }
    std::size_t rows() const noexcept { return rows_; }
    const BodyPositions& positions() const noexcept { return positions_; }
    const Ellipsoid& ellipsoid() const noexcept { return positions_.ellipsoid(); }

    /// Whether the last column lies where the first one does.
    bool closes() const noexcept { return positions_.wraps(); }
    /// The raster's column that is drawn as `column`.
    std::size_t rasterColumn(std::size_t column) const noexcept
    {
        return repeats_first_ && column + 1 == columns_ ? 0 : column;
    }
    /// Whether all samples of a row lie at a pole: their heights must be equal.
    bool isPole(std::size_t row) const noexcept
    {
        return row < positions_.firstRow() || row >= positions_.firstRow() + positions_.rows();
    }
    /// The pole at the first row, or next to it on a map around the body, and that at the last row.
    /// Unless isPole() of the row, triangles from it to the pole close the map.
    Pole poleAtFirstRow() const noexcept { return first_pole_; }
    Pole poleAtLastRow() const noexcept { return last_pole_; }

    /// Unchecked: column < columns(), row < rows(). `height_m` is exaggerated by the caller.
    Vec3 at(std::size_t column, std::size_t row, double height_m) const noexcept;
    Vec3 atPole(Pole pole, double height_m) const noexcept;
    /// The ellipsoid's normal, of length 1.
    Vec3 normal(std::size_t column, std::size_t row) const noexcept;
    /// Differences to the neighbors on both sides. Next to a pole, those of the nearest row off it.
    Steps steps(std::size_t column, std::size_t row) const noexcept;

    /// Bounds over all samples at height 0, with some margin: the longest step to the next column
    /// or row, the diagonal of so many cells, and how far a triangle whose legs are `cells` long
    /// lies off the ellipsoid.
    double stepMaxM() const noexcept { return std::max(column_step_max_m_, row_step_max_m_); }
    double diagonalMaxM(double columns, double rows) const noexcept
    {
        const double across = columns * column_step_max_m_;
        const double down = rows * row_step_max_m_;
        return std::sqrt(across * across + down * down + 2.0 * across * down * skew_max_);
    }
    double sagM(double cells) const noexcept { return sag_per_square_m_ * cells * cells; }

private:
    explicit BodyGrid(BodyPositions positions, const Georeference& georeference);
    void measure();
    std::size_t offPole(std::size_t row) const noexcept;
    // The column of the positions.
    std::size_t placeOf(std::size_t column) const noexcept
    {
        return positions_.wraps() && column + 1 == columns_ ? 0 : column;
    }

    BodyPositions positions_;
    std::size_t columns_;
    std::size_t rows_;
    bool repeats_first_ = false; // in the last column, which the raster lacks
    Pole first_pole_ = Pole::None;
    Pole last_pole_ = Pole::None;
    double column_step_max_m_ = 0.0;
    double row_step_max_m_ = 0.0;
    double skew_max_ = 0.0; // cosine of the angle between a step and the other
    double sag_per_square_m_ = 0.0;
};

} // namespace marsview
