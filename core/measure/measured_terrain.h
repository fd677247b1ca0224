// The terrain that measurements are made on.
#pragma once

#include "core/geo/georeference.h"
#include "core/measure/cap_plane.h"
#include "core/measure/ground.h"
#include "core/measure/sample_reader.h"
#include "core/terrain/triangulation.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace marsview {

/// A position in a cell of the triangulated surface (triangulation.h).
struct CellPlace {
    std::size_t column = 0; // counted in cells
    std::size_t row = 0;
    double u = 0.0; // in [0, 1]
    double v = 0.0;
};

/// What closes a map around the body between its outermost row of samples and the pole.
struct CapTerrain {
    CapPlane plane;
    std::size_t row = 0;   // the line between cells, first or last
    double radius_m = 0.0; // of the circle that the row is, at elevation 0
    double pole_m = 0.0;   // elevation; NaN if a sample that it depends on is void

    /// A point, and the column of cells that it lies in.
    struct Place {
        std::size_t column = 0;
        CapPlane::Point point;
    };
};

/// Whether samples are those of the raster, or fewer, as in a preview.
enum class TerrainDetail { OfSamples, Approximate };

/// The triangulated surface of a raster, on the ground of its body: the ellipsoid of its CRS, or a
/// plane without a CRS. The samples may be every 2^k-th ones: the surface is then approximate. For
/// one thread at a time.
///
/// Columns may be counted beyond the grid: where longitude is periodic, they are those of the next
/// turn, and on a map around the whole body the last and the first column are neighbors. If the
/// outermost row of such a map is next to a pole, the triangles of a PoleCap close it there.
class MeasuredTerrain {
public:
    /// `samples` are those of `georeference`'s raster, at least 2 × 2.
    MeasuredTerrain(const Georeference& georeference,
                    std::unique_ptr<SampleReader> samples,
                    TerrainDetail detail = TerrainDetail::OfSamples);

    const Georeference& georeference() const noexcept { return georeference_; }
    const Ground& ground() const noexcept { return ground_; }
    /// Of a preview, or of a coarser level.
    bool isApproximate() const noexcept
    {
        return detail_ == TerrainDetail::Approximate || samples_->step() > 1;
    }
    /// Why a sample could not be read; elevations are NaN there.
    const std::optional<Error>& failure() const noexcept { return samples_->failure(); }

    /// Positions of the raster's map coordinates; empty outside its projection.
    std::optional<GroundPosition> fromMap(MapPoint map) const;
    std::optional<GroundPosition> fromGrid(GridPoint grid) const;
    /// Empty outside the projection. Columns are those nearest to the center of the raster.
    std::optional<GridPoint> toGrid(GroundPosition position) const;

    /// Map coordinates in the raster's CRS; empty outside its projection.
    std::optional<MapPoint> toMap(GroundPosition position) const;
    /// The position with its longitude in the turn in which Georeference counts longitudes: nearest
    /// to the center of a map on which longitude is periodic, otherwise in [-180°, 180°].
    GroundPosition inTurn(GroundPosition position) const;

    /// Elevation in meters; NaN in voids and outside the outermost samples, except between them and
    /// a pole that the map closes at.
    double elevation(GroundPosition position);
    double elevation(const CellPlace& place);
    /// Of the crossing of two lines between cells; column in [0, cellColumns()].
    double vertex(std::size_t column, std::size_t row)
    {
        return samples_->sample(columns_.sample(column), rows_.sample(row));
    }
    /// As elevation(), of the corners of a cell.
    CellHeights cell(std::size_t column, std::size_t row);

    // The triangles at the poles. Their vertices have the heights that they have on the globe,
    // which are linear along each of the ways from the pole to the samples of the row.

    /// What closes the map beyond its first or last row, if `row` of the grid is beyond it and that
    /// row is not at the pole itself; otherwise null. Constant after the first call.
    const CapTerrain* capBeyond(double row);
    /// Of a position between the row and the pole.
    CapTerrain::Place placeIn(const CapTerrain& cap, GroundPosition position) const;
    /// The direction away from the pole at a position, of length 1. At the pole, that of its
    /// longitude.
    CapPlane::Point outwardIn(GroundPosition position) const;
    /// Counter-clockwise in the plane of a cap is then east.
    bool columnsRunEast() const noexcept { return columns_per_degree_ > 0.0; }
    /// NaN if a corner that counts at the point is void.
    double elevation(const CapTerrain& cap, std::uint32_t face, const CapPlane::Point& point);
    std::array<double, 3> corners(const CapTerrain& cap, std::uint32_t face);

    // The cells. Those of the seam of a map around the whole body come last.

    std::size_t cellColumns() const noexcept { return columns_.cells; }
    std::size_t cellRows() const noexcept { return rows_.cells; }
    /// The columns of a turn of longitude; 0 where longitude is not periodic along columns.
    double period() const noexcept { return period_; }
    bool wrapsAround() const noexcept { return georeference_.wrapsAround(); }
    /// The grid position of a line between cells: index in [0, cellColumns()].
    double columnLine(std::size_t index) const noexcept { return columns_.line(index); }
    double rowLine(std::size_t index) const noexcept { return rows_.line(index); }
    /// The turn that a column is in: columns of turn 0 are nearest to the center of the raster.
    double turnOf(double column) const noexcept
    {
        return period_ > 0.0 ? std::floor((column - turn_begin_) / period_) : 0.0;
    }
    /// The cell of a position in any turn; empty outside, except within a millionth of a sample. At
    /// a line it is the next cell, except at the last one.
    std::optional<CellPlace> placeOf(GridPoint grid) const;
    /// The column of cells alone, for positions beyond the first or last row; v and row are 0.
    std::optional<CellPlace> placeInColumns(double column) const;

private:
    // Lines between cells along an axis: every step-th sample, the last one, and the first one of
    // the next turn.
    struct Axis {
        std::size_t cells = 0;
        std::size_t step = 1;
        std::size_t last = 0;  // sample
        double seam_end = 0.0; // line after the seam; 0: none

        double line(std::size_t index) const noexcept
        {
            const std::size_t sample = index * step;
            if (sample <= last || seam_end == 0.0) {
                return static_cast<double>(sample < last ? sample : last);
            }
            return index == cells ? seam_end : static_cast<double>(last);
        }
        // The cell of a position and the position's share of it; false outside.
        bool find(double at, std::size_t& cell, double& share) const;
        std::size_t sample(std::size_t index) const noexcept
        {
            if (seam_end != 0.0 && index == cells) {
                return 0;
            }
            const std::size_t sample = index * step;
            return sample < last ? sample : last;
        }
    };

    void findCaps();
    std::unique_ptr<const CapTerrain> capAt(std::size_t row);

    Georeference georeference_;
    Ground ground_;
    std::unique_ptr<SampleReader> samples_;
    TerrainDetail detail_;
    Axis columns_;
    Axis rows_;
    double period_ = 0.0;
    double turn_begin_ = 0.0;
    double center_longitude_deg_ = 0.0;
    // Beyond the first and the last row.
    std::array<bool, 2> has_cap_{};
    std::array<std::unique_ptr<const CapTerrain>, 2> caps_; // when first asked for
    double first_longitude_deg_ = 0.0;
    double columns_per_degree_ = 0.0; // eastward
};

} // namespace marsview
