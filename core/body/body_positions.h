// Where the samples of a raster lie on their body.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/base/vec.h"
#include "core/geo/georeference.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace marsview {

/// Positions in the body-fixed frame, in meters: x through longitude 0° on the equator, z through
/// the north pole. A sample at a height lies on the normal of an ellipsoid, at its foot point S:
/// S + height · n. So a vertex has one position wherever it is computed.
///
/// In cylindrical systems longitude depends only on the column and latitude only on the row: sines
/// and cosines come from tables. In others, polynomials per block of samples replace the
/// projection; blocks are as small as it takes to keep their error below 1e-6 of a cell and 0.1 mm.
///
/// Immutable; any thread, the servo thread included: at() allocates and locks nothing.
class BodyPositions {
public:
    /// A place on the ellipsoid and the normal there.
    struct Foot {
        Vec3 surface_m;
        Vec3 normal; // of length 1
    };

    /// Errors: Invalid if the raster has no body, extends over more than a full turn of longitude,
    /// beyond a pole or to places without coordinates; Canceled. Projections take about 0.1 µs per
    /// sample. On the ellipsoid of a scene, otherwise on the raster's own: samples keep their
    /// longitude, planetocentric latitude and height.
    static Result<BodyPositions> make(const Georeference& georeference,
                                      JobMonitor& monitor,
                                      const std::optional<Ellipsoid>& scene = std::nullopt);

    /// The samples that are used. A column that repeats the first one after a full turn, and rows
    /// that lie at a pole, where all their samples meet, are left out.
    std::size_t columns() const noexcept { return columns_; }
    std::size_t rows() const noexcept { return rows_; }
    /// The row of the raster that is row 0 here.
    std::size_t firstRow() const noexcept { return first_row_; }
    /// Whether the last column is next to the first.
    bool wraps() const noexcept { return wraps_; }
    /// Whether the first and the last row go around a pole at a distance of at most one cell.
    bool closesAtFirstRow() const noexcept { return closes_first_; }
    bool closesAtLastRow() const noexcept { return closes_last_; }
    /// Whether the raster has a row before the first one here, or after the last, at a pole.
    bool hasRowAtPole(bool is_before) const noexcept
    {
        return is_before ? first_row_ > 0 : has_row_after_;
    }
    /// Whether columns turn to rows counter-clockwise, seen from outside.
    bool isMirrored() const noexcept { return is_mirrored_; }
    const Ellipsoid& ellipsoid() const noexcept { return ellipsoid_; }

    /// Unchecked: column < columns(), row < rows(). `height_m` is exaggerated by the caller.
    Vec3 at(std::size_t column, std::size_t row, double height_m) const noexcept
    {
        if (!row_table_.empty()) {
            const Row& r = row_table_[row];
            const Column& c = column_table_[column];
            const double out = r.out_m + height_m * r.cosine;
            return {out * c.cosine, out * c.sine, r.up_m + height_m * r.sine};
        }
        const Foot foot = footFromBlocks(column, row);
        return foot.surface_m + foot.normal * height_m;
    }

private:
    struct Row {
        double out_m; // the distance from the axis
        double up_m;
        double cosine; // of the planetographic latitude
        double sine;
    };
    struct Column {
        double cosine;
        double sine;
    };
    /// The samples from column · size to the next block, or to the last one, as -1 to 1.
    struct Range {
        double middle;
        double per_half;
    };
    static constexpr std::size_t kTerms = 10; // of a polynomial of degree 3
    /// Of x, y, z and 1 / N, by term. N is the ellipsoid's radius of curvature in the prime
    /// vertical: the normal is (x, y, z a² / b²) / N.
    using Components = std::array<double, 4>;
    using Block = std::array<Components, kTerms>;

    class Maker;

    BodyPositions() = default;
    Foot footFrom(const Block& block, double u, double v) const noexcept;
    Foot footFromBlocks(std::size_t column, std::size_t row) const noexcept;

    std::size_t columns_ = 0;
    std::size_t rows_ = 0;
    std::size_t first_row_ = 0;
    bool wraps_ = false;
    bool has_row_after_ = false;
    bool closes_first_ = false;
    bool closes_last_ = false;
    bool is_mirrored_ = false;
    Ellipsoid ellipsoid_;
    double axes_squared_ = 1.0; // a² / b²
    std::vector<Row> row_table_;
    std::vector<Column> column_table_;
    unsigned block_shift_ = 0;
    std::size_t blocks_per_row_ = 0;
    std::vector<Range> block_columns_;
    std::vector<Range> block_rows_;
    std::vector<Block> blocks_;
};

/// The foot point of a place on an ellipsoid, and the normal there.
BodyPositions::Foot footOf(const Ellipsoid& ellipsoid, const GeographicPoint& place) noexcept;

/// The ellipsoid's normal through a point in the body-fixed frame, of length 1, and the height of
/// the point along it. Rounding errors only.
struct BodyVertical {
    Vec3 up;
    double height_m = 0.0;
};
BodyVertical verticalAt(const Ellipsoid& ellipsoid, const Vec3& point) noexcept;

} // namespace marsview
