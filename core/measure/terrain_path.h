// Lines on the ground as they cross the triangles of the terrain.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/measure/measured_terrain.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace marsview {

/// A part of a line as a cubic curve on the grid, within 1e-7 of a sample, or beyond the raster
/// within a thousandth of the distance to it. Columns continue without a jump where longitude is
/// periodic.
struct GridCurve {
    double begin_m = 0.0; // along the line
    double end_m = 0.0;
    bool is_on_map = true; // false: outside the projection, or across its edge
    /// Not on the map, and through a pole that is a row of the grid: the curve is the part of that
    /// row between the meridians before and after it.
    bool is_along_pole = false;
    std::array<double, 4> column{}; // coefficients of t^0 … t^3, t in [0, 1]
    std::array<double, 4> row{};

    GridPoint at(double t) const noexcept
    {
        return {((column[3] * t + column[2]) * t + column[1]) * t + column[0],
                ((row[3] * t + row[2]) * t + row[1]) * t + row[0]};
    }
};

/// The whole of `line`, from its start to its end, in order.
std::vector<GridCurve> gridCurves(const MeasuredTerrain& terrain, const GroundLine& line);

/// A part of a line within one triangle of the terrain, or without terrain. Between its ends the
/// elevation is linear along the line, within 0.1 mm.
struct PathPiece {
    double begin_m = 0.0; // along the line
    double end_m = 0.0;
    bool has_terrain = false;
    bool is_on_map = true; // false: beyond the outermost samples, or outside the projection
    // NaN where a sample that counts there is void.
    double begin_elevation_m = 0.0;
    double end_elevation_m = 0.0;
};

/// Receives the parts of a line, in order.
class PathVisitor {
public:
    virtual ~PathVisitor() = default;
    virtual void visit(const PathPiece& piece) = 0;
    /// In a cap also: a straight part in its plane, within one triangle. They follow each other
    /// without a gap.
    virtual void visitCap(const CapTerrain& /*cap*/,
                          std::uint32_t /*face*/,
                          const CapPlane::Point& /*from*/,
                          const CapPlane::Point& /*to*/)
    {}
};

/// Cuts `line` at every edge of the terrain's triangles that it crosses. Along an edge, the
/// elevation is that of its two ends. Between the outermost row and a pole that the map closes at,
/// these are the triangles of a PoleCap. Reads only cells on the line, and the samples that a pole
/// depends on. Canceled when `monitor` is, and the first error of reading.
Status tracePath(MeasuredTerrain& terrain,
                 const GroundLine& line,
                 JobMonitor& monitor,
                 PathVisitor& visitor);

/// An upper estimate of how many parts the lines between these positions have; for choosing a
/// coarser level. Calls PROJ a few hundred times.
double estimatedPieces(const MeasuredTerrain& terrain, std::span<const GroundPosition> positions);

/// A parameter at which a curve meets a line between cells.
struct CellCut {
    double t = 0.0;
    // The line's grid position, if it is one between columns or rows; NaN otherwise.
    double column = std::numeric_limits<double>::quiet_NaN();
    double row = std::numeric_limits<double>::quiet_NaN();
};

/// Where a curve enters another cell, ascending, into `cuts`, with t = 0 and t = 1. Columns are
/// those of the curve: in any turn.
void findCellCuts(const MeasuredTerrain& terrain,
                  const GridCurve& curve,
                  std::vector<CellCut>& cuts);

} // namespace marsview
