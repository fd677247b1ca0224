#include "core/annotations/drawn_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace marsview {
namespace {

constexpr double kPieceDeg = 0.5; // of arc, between positions of a line

} // namespace

DrawnGeometry::DrawnGeometry(const std::optional<Crs>& crs)
    : crs_(crs)
{
    if (crs_) {
        ground_ = Ground::onEllipsoid(*crs_->ellipsoid());
        piece_m_ = crs_->ellipsoid()->equatorial_m * kPieceDeg * std::numbers::pi / 180.0;
    }
}

std::vector<GroundPosition> DrawnGeometry::positions(std::span<const DrawnVertex> vertices) const
{
    std::vector<GroundPosition> positions;
    positions.reserve(vertices.size() + 1);
    for (const DrawnVertex& vertex : vertices) {
        positions.push_back(ground_->position(std::get<GeographicPoint>(vertex)));
    }
    return positions;
}

MapPoint DrawnGeometry::mapPoint(GroundPosition position) const
{
    return crs_->toMap(ground_->geographic(position)).value_or(MapPoint{position.x, position.y});
}

std::vector<MapPoint> DrawnGeometry::points(std::span<const DrawnVertex> vertices) const
{
    std::vector<MapPoint> points;
    points.reserve(vertices.size() + 1);
    if (!crs_) {
        for (const DrawnVertex& vertex : vertices) {
            points.push_back(std::get<MapPoint>(vertex));
        }
        return points;
    }
    for (const GroundPosition position : positions(vertices)) {
        points.push_back(mapPoint(position));
    }
    return points;
}

std::vector<MapPoint> DrawnGeometry::line(std::span<const DrawnVertex> vertices,
                                          LineEnds ends) const
{
    if (crs_) {
        std::vector<GroundPosition> corners = positions(vertices);
        return ends == LineEnds::Closed ? closedLine(std::move(corners)) : between(corners);
    }
    std::vector<MapPoint> line = points(vertices);
    if (ends == LineEnds::Closed) {
        line.push_back(line.front());
    }
    return line;
}

std::vector<MapPoint> DrawnGeometry::closedLine(std::vector<GroundPosition> corners) const
{
    corners.push_back(corners.front());
    return between(corners);
}

std::vector<MapPoint> DrawnGeometry::between(const std::vector<GroundPosition>& corners) const
{
    std::vector<MapPoint> points{mapPoint(corners.front())};
    double turns = 0.0; // degrees, so that longitudes continue from one leg to the next
    for (std::size_t i = 1; i < corners.size(); ++i) {
        const GroundLine leg = ground_->line(corners[i - 1], corners[i]);
        const auto pieces = static_cast<int>(std::ceil(leg.lengthM() / piece_m_));
        for (int piece = 1; piece < pieces; ++piece) {
            GroundPosition position = leg.at(piece * leg.lengthM() / pieces);
            position.x += turns;
            points.push_back(mapPoint(position));
        }
        // The corner itself: borders end with exactly their first position.
        constexpr double kTurn = 360.0;
        turns += kTurn * std::round((leg.at(leg.lengthM()).x - corners[i].x) / kTurn);
        points.push_back(mapPoint({corners[i].x + turns, corners[i].y}));
    }
    return points;
}

} // namespace marsview
