#include "core/geo/georeference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace marsview {
namespace {

// Meters in one unit of map x and map y, signed so that positive is east and north.
struct MetersPerUnit {
    double x = 1.0;
    double y = 1.0;
};

// A geographic raster is flattened with the scale at its center: there, one degree has the same
// length in both directions as on the ellipsoid at that latitude.
MetersPerUnit metersPerUnit(const std::optional<Crs>& crs, MapPoint center)
{
    if (!crs) {
        return {};
    }
    if (crs->kind() != CrsKind::Geographic) {
        return {crs->unit() * crs->eastSign(), crs->unit() * crs->northSign()};
    }
    const Ellipsoid& ellipsoid = *crs->ellipsoid();
    constexpr double kLatitudeMaxRad =
        89.9 * std::numbers::pi / 180.0; // keeps the scale invertible
    const Angle latitude =
        Angle::radians(std::clamp(center.y * crs->unit(), -kLatitudeMaxRad, kLatitudeMaxRad));
    const bool is_centric = crs->latitudeKind() == LatitudeKind::Planetocentric;
    const Angle graphic = is_centric ? ellipsoid.planetographic(latitude) : latitude;
    const double north = is_centric ? ellipsoid.metersPerRadianOfPlanetocentricLatitude(graphic)
                                    : ellipsoid.metersPerRadianOfPlanetographicLatitude(graphic);
    return {ellipsoid.metersPerRadianOfLongitude(graphic) * crs->unit() * crs->eastSign(),
            north * crs->unit() * crs->northSign()};
}

// A round trip from a sample to map coordinates, or to longitude and latitude, rounds by up to
// 3e-10 sample. A position that is outside the grid or next to a void by less is never intended.
constexpr double kRounding = 1e-9;

double withoutRounding(double position)
{
    const double nearest = std::round(position);
    return std::abs(position - nearest) <= kRounding ? nearest : position;
}

} // namespace

Georeference::Georeference(std::size_t columns,
                           std::size_t rows,
                           const GeoTransform& transform,
                           std::optional<Crs> crs)
    : columns_(columns)
    , rows_(rows)
    , transform_(transform)
    , crs_(std::move(crs))
{
    const GridPoint center{(static_cast<double>(columns_) - 1.0) / 2.0,
                           (static_cast<double>(rows_) - 1.0) / 2.0};
    const MetersPerUnit scale = metersPerUnit(crs_, toMap(center));
    const GeoTransform::Terms& t = transform_.terms();
    scene_frame_ = {.origin = center,
                    .east_per_column = t[1] * scale.x,
                    .east_per_row = t[2] * scale.x,
                    .north_per_column = t[4] * scale.y,
                    .north_per_row = t[5] * scale.y};
    if (!crs_ || !crs_->turn()) {
        return;
    }
    if (const auto origin = crs_->toGeographic(toMap(center))) {
        constexpr double kHalfTurn = std::numbers::pi;
        center_longitude_ = origin->longitude.radians() <= -kHalfTurn
                                ? Angle::radians(origin->longitude.radians() + 2.0 * kHalfTurn)
                                : origin->longitude;
    }
    if (t[2] == 0.0 && t[4] == 0.0) {
        const double columns_per_turn = *crs_->turn() / std::abs(t[1]);
        wraps_around_ = std::abs(columns_per_turn - static_cast<double>(columns_)) < 0.5;
    }
}

GridPoint Georeference::toGrid(MapPoint map) const noexcept
{
    const GridPoint grid = transform_.toGrid(map);
    return {withoutRounding(grid.column), withoutRounding(grid.row)};
}

std::optional<GeographicPoint> Georeference::toGeographic(GridPoint grid) const
{
    if (!crs_) {
        return std::nullopt;
    }
    const MapPoint map = toMap(grid);
    std::optional<GeographicPoint> point = crs_->toGeographic(map);
    if (point && crs_->turn()) {
        const double turns_from_center =
            crs_->eastSign() * (map.x - toMap(scene_frame_.origin).x) / *crs_->turn();
        const double expected_deg = center_longitude_.degrees() + 360.0 * turns_from_center;
        const double whole_turns = std::round((expected_deg - point->longitude.degrees()) / 360.0);
        if (whole_turns != 0.0) {
            point->longitude = Angle::degrees(point->longitude.degrees() + 360.0 * whole_turns);
        }
    }
    return point;
}

std::optional<GridPoint> Georeference::toGrid(GeographicPoint geographic) const
{
    if (!crs_) {
        return std::nullopt;
    }
    std::optional<MapPoint> map = crs_->toMap(geographic);
    if (!map) {
        return std::nullopt;
    }
    if (const auto& turn = crs_->turn()) {
        // Among the positions that differ by whole turns, the one nearest to the center is on the
        // raster if any is, because no raster extends more than half a turn from its center; a
        // global raster is cut there, at its seam.
        const double center_x = toMap(scene_frame_.origin).x;
        map->x += *turn * std::round((center_x - map->x) / *turn);
    }
    return toGrid(*map);
}

GridPoint Georeference::toGrid(GridPoint grid, const Georeference& other) const
{
    if (&other == this) {
        return grid;
    }
    if (const auto place = other.toGeographic(grid)) {
        if (const auto there = toGrid(*place)) {
            return *there; // in the right turn of longitude
        }
    }
    return toGrid(other.toMap(grid));
}

double Georeference::pixelWidthMeters() const noexcept
{
    return std::hypot(scene_frame_.east_per_column, scene_frame_.north_per_column);
}

double Georeference::pixelHeightMeters() const noexcept
{
    return std::hypot(scene_frame_.east_per_row, scene_frame_.north_per_row);
}

} // namespace marsview
