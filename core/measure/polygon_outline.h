// The edges of a polygon, cut into straight parts on the grid.
#pragma once

#include "core/base/result.h"
#include "core/measure/measured_terrain.h"

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace marsview {

/// A straight part of an edge within a column of cells: in a cell, or above the first row.
struct EdgePart {
    std::size_t column = 0; // of the cell
    std::size_t row = 0;
    bool is_above = false; // row and v are 0
    // Ends in the cell, in [0, 1] (triangulation.h).
    double u0 = 0.0;
    double v0 = 0.0;
    double u1 = 0.0;
    double v1 = 0.0;
};

/// The edges on the grid. Parts below the last row or outside the columns of the grid are omitted.
struct PolygonOutline {
    std::vector<EdgePart> parts;
    double turn_columns = 0.0; // how far the edges advance: 0, or a turn around a pole
    double area = 0.0;         // signed: positive if columns to rows is the way around
    GridPoint low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    GridPoint high{-std::numeric_limits<double>::infinity(),
                   -std::numeric_limits<double>::infinity()};
};

/// Of the closed polygon with these vertices. Parts are straight within 1e-6 of a sample.
/// OutOfRange if an edge leaves the map's projection.
Result<PolygonOutline> outlineOf(const MeasuredTerrain& terrain,
                                 std::span<const GroundPosition> vertices);

} // namespace marsview
