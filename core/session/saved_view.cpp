#include "core/session/saved_view.h"

#include <cmath>
#include <numbers>

namespace marsview {
namespace {

constexpr double kPositionDegrees = 1e-10;
constexpr double kAngleDegrees = 1e-6;

// Far enough for the projection's rounding, near enough for its curvature.
constexpr Angle kNorthProbe = Angle::degrees(1e-4);

bool hasBody(const Georeference& georeference)
{
    return georeference.crs() && georeference.crs()->kind() != CrsKind::Local;
}

Angle roundedTo(Angle angle, double step_degrees)
{
    return Angle::degrees(std::round(angle.degrees() / step_degrees) * step_degrees);
}

Angle withinHalfTurn(Angle angle)
{
    return Angle::radians(std::remainder(angle.radians(), 2.0 * std::numbers::pi));
}

// The direction of true north in the scene at a point, clockwise from the scene's y axis. Measured
// along the meridian towards the equator, which also exists at a pole.
Angle northAt(const Georeference& georeference, const GeographicPoint& point)
{
    const bool is_north = point.latitude.radians() >= 0.0;
    const auto here = georeference.toGrid(point);
    const auto there = georeference.toGrid(
        GeographicPoint{.longitude = point.longitude,
                        .latitude = point.latitude + (is_north ? -kNorthProbe : kNorthProbe)});
    if (!here || !there) {
        return {};
    }
    const SceneFrame& frame = georeference.sceneFrame();
    const Vec3 step = frame.toScene(*there, 0.0) - frame.toScene(*here, 0.0);
    return is_north ? Angle::radians(std::atan2(-step.x, -step.y))
                    : Angle::radians(std::atan2(step.x, step.y));
}

} // namespace

std::optional<ViewCamera>
viewCamera(const Georeference& georeference, const OrbitCamera& camera, double exaggeration)
{
    ViewCamera view{.elevation_m = camera.target.z / exaggeration,
                    .distance_m = camera.distance_m,
                    .azimuth = camera.azimuth,
                    .tilt = roundedTo(camera.tilt, kAngleDegrees),
                    .field_of_view = roundedTo(camera.field_of_view, kAngleDegrees)};
    const GridPoint grid = georeference.sceneFrame().toGrid(camera.target);
    if (hasBody(georeference)) {
        const auto point = georeference.toGeographic(grid);
        if (!point) {
            return std::nullopt;
        }
        const GeographicPoint target{.longitude = roundedTo(point->longitude, kPositionDegrees),
                                     .latitude = roundedTo(point->latitude, kPositionDegrees)};
        view.target = target;
        view.azimuth = withinHalfTurn(camera.azimuth - northAt(georeference, target));
    } else {
        view.target = georeference.toMap(grid);
    }
    view.azimuth = roundedTo(view.azimuth, kAngleDegrees);
    return view;
}

std::optional<OrbitCamera>
orbitCamera(const Georeference& georeference, const ViewCamera& camera, double exaggeration)
{
    std::optional<GridPoint> grid;
    Angle azimuth = camera.azimuth;
    if (const auto* point = std::get_if<GeographicPoint>(&camera.target)) {
        if (!hasBody(georeference)) {
            return std::nullopt;
        }
        grid = georeference.toGrid(*point);
        azimuth = withinHalfTurn(azimuth + northAt(georeference, *point));
    } else if (!hasBody(georeference)) {
        grid = georeference.toGrid(std::get<MapPoint>(camera.target));
    }
    if (!grid) {
        return std::nullopt;
    }
    return OrbitCamera{
        .target = georeference.sceneFrame().toScene(*grid, camera.elevation_m * exaggeration),
        .distance_m = camera.distance_m,
        .azimuth = azimuth,
        .tilt = camera.tilt,
        .field_of_view = camera.field_of_view};
}

} // namespace marsview
