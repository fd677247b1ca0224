// Positions on a body as coordinates in files, with lines that follow the shortest lines.
#pragma once

#include "core/annotations/drawn_vertex.h"
#include "core/geo/crs.h"
#include "core/measure/ground.h"
#include "core/vector/feature.h"

#include <optional>
#include <span>
#include <vector>

namespace marsview {

enum class LineEnds { Open, Closed };

/// In longitude and latitude of `crs`, which has an ellipsoid; without a CRS, map coordinates and
/// straight lines. Positions are all of the one kind or of the other. Immutable; any thread.
class DrawnGeometry {
public:
    explicit DrawnGeometry(const std::optional<Crs>& crs);

    std::vector<MapPoint> points(std::span<const DrawnVertex> vertices) const;
    /// Consecutive positions are at most half a degree of arc apart, and longitudes do not jump. A
    /// closed line ends with its first position.
    std::vector<MapPoint> line(std::span<const DrawnVertex> vertices, LineEnds ends) const;

    // Only with a CRS.
    const Ground& ground() const noexcept { return *ground_; }
    MapPoint mapPoint(GroundPosition position) const;
    std::vector<MapPoint> closedLine(std::vector<GroundPosition> corners) const;

private:
    std::vector<GroundPosition> positions(std::span<const DrawnVertex> vertices) const;
    std::vector<MapPoint> between(const std::vector<GroundPosition>& corners) const;

    std::optional<Crs> crs_;
    std::optional<Ground> ground_;
    double piece_m_ = 0.0;
};

} // namespace marsview
