#include "core/session/measurement.h"

#include "core/measure/polygon_outline.h"
#include "core/measure/terrain_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

// A first result reads some hundred tiles at most.
constexpr double kQuickPoints = 8192.0; // parts of a line
constexpr double kQuickCells = 4e6;     // cells of an area

// The positions on the ground of `terrain`. Invalid if some are on a body and the map has none, or
// the other way around.
Result<std::vector<GroundPosition>> positionsOf(const Measurement& measurement,
                                                const MeasuredTerrain& terrain)
{
    std::vector<GroundPosition> positions;
    const bool is_on_body = terrain.ground().ellipsoid().has_value();
    for (const MeasuredVertex& vertex : measurement.vertices) {
        if (std::holds_alternative<GeographicPoint>(vertex) != is_on_body) {
            return Error{ErrorCode::Invalid,
                         is_on_body ? "was measured while the map had no CRS; measure it again"
                                    : "was measured on a body, but the map has no CRS now; set its "
                                      "CRS again"};
        }
        if (is_on_body) {
            positions.push_back(terrain.ground().position(std::get<GeographicPoint>(vertex)));
        } else if (const auto position = terrain.fromMap(std::get<MapPoint>(vertex))) {
            positions.push_back(*position);
        }
    }
    return positions;
}

std::size_t areaLevel(const MeasuredTerrain& terrain, const std::vector<GroundPosition>& positions)
{
    if (positions.size() < 3) {
        return 0;
    }
    const auto cells = [&] {
        const Result<PolygonOutline> outline = outlineOf(terrain, positions);
        const auto all =
            static_cast<double>(terrain.cellColumns()) * static_cast<double>(terrain.cellRows());
        return outline ? std::min(all, (outline->high.column - outline->low.column) *
                                           (outline->high.row - outline->low.row))
                       : all;
    }();
    return static_cast<std::size_t>(
        std::max(0.0, std::ceil(0.5 * std::log2(std::max(1.0, cells / kQuickCells)))));
}

std::size_t levelFor(MeasurementKind kind,
                     const MeasuredTerrain& terrain,
                     const std::vector<GroundPosition>& positions)
{
    switch (kind) {
    case MeasurementKind::Distance:
    case MeasurementKind::Profile:
        return positions.size() < 2 ? 0 : profileLevel(terrain, positions, kQuickPoints);
    case MeasurementKind::Area:
    case MeasurementKind::Crater:
        return areaLevel(terrain, positions);
    case MeasurementKind::Attitude:
    case MeasurementKind::Slope:
        return 0; // a few samples each
    }
    return 0;
}

template <typename T>
Result<MeasuredValues> asValues(Result<T> result)
{
    return result ? Result<MeasuredValues>(MeasuredValues(std::move(*result)))
                  : Result<MeasuredValues>(std::move(result).error());
}

Result<MeasuredValues> valuesOf(const Measurement& measurement,
                                const Map& map,
                                MeasuredTerrain& terrain,
                                const std::vector<GroundPosition>& positions,
                                JobMonitor& monitor)
{
    switch (measurement.kind) {
    case MeasurementKind::Distance:
        return asValues(measureDistance(terrain, positions, monitor));
    case MeasurementKind::Area: {
        auto area = measureArea(terrain, positions, measurement.area, monitor);
        const bool is_plane = measurement.area.base == VolumeBase::BorderPlane;
        if (!area && area.error().code != ErrorCode::Canceled && is_plane) {
            // Where no plane can be placed, everything but the volumes remains.
            AreaOptions options = measurement.area;
            options.base = VolumeBase::None;
            if (auto rest = measureArea(terrain, positions, options, monitor)) {
                area = std::move(rest);
            }
        }
        return asValues(std::move(area));
    }
    case MeasurementKind::Profile:
        return asValues(measureProfile(terrain, positions, measurement.step_m, monitor));
    case MeasurementKind::Attitude: {
        const double elevation_m = positions.empty() ? 0.0 : terrain.elevation(positions.front());
        return asValues(measureAttitude(
            terrain, positions,
            {.elevation_error_m = measurement.elevation_error_m,
             .default_elevation_error_m = elevationStepError(map.info(), elevation_m)}));
    }
    case MeasurementKind::Crater:
        return asValues(measureCrater(terrain, positions, monitor));
    case MeasurementKind::Slope:
        return asValues(measureSlopes(terrain, positions, measurement.baseline_m, monitor));
    }
    MARSVIEW_CHECK(false);
}

} // namespace

MeasuredTerrain measuredTerrain(const Map& map, std::size_t level)
{
    return {map.georeference(), readSamples(map.heightfield(), level),
            map.isPreview() ? TerrainDetail::Approximate : TerrainDetail::OfSamples};
}

std::optional<MeasuredVertex> vertexAt(const Georeference& georeference, GridPoint grid)
{
    if (!georeference.crs() || georeference.crs()->kind() == CrsKind::Local) {
        return MeasuredVertex(georeference.toMap(grid));
    }
    const auto point = georeference.toGeographic(grid);
    return point ? std::optional(MeasuredVertex(*point)) : std::nullopt;
}

std::shared_ptr<const MeasurementResult>
measured(const Measurement& measurement, const Map& map, MeasureDetail detail, JobMonitor& monitor)
{
    MeasuredTerrain terrain = measuredTerrain(map);
    const Result<std::vector<GroundPosition>> positions = positionsOf(measurement, terrain);
    if (!positions) {
        return std::make_shared<const MeasurementResult>(
            MeasurementResult{.map = map.spec(), .values = positions.error()});
    }
    if (detail == MeasureDetail::Quick) {
        if (const std::size_t level = levelFor(measurement.kind, terrain, *positions); level > 0) {
            terrain = measuredTerrain(map, level);
        }
    }
    std::vector<double> elevations_m;
    for (const GroundPosition& position : *positions) {
        elevations_m.push_back(terrain.elevation(position));
    }
    const MeasuredResolution resolution = resolutionOf(
        map.georeference(), map.info(), elevations_m.empty() ? std::nan("") : elevations_m.front());
    Result<MeasuredValues> values = valuesOf(measurement, map, terrain, *positions, monitor);
    if (!values && values.error().code == ErrorCode::Canceled) {
        return nullptr;
    }
    return std::make_shared<const MeasurementResult>(
        MeasurementResult{.map = map.spec(),
                          .values = std::move(values),
                          .is_approximate = terrain.isApproximate(),
                          .elevations_m = std::move(elevations_m),
                          .resolution = resolution});
}

bool isCurrent(const Measurement& measurement, const Map& map)
{
    return measurement.result && measurement.result->map == map.spec() &&
           (!measurement.result->is_approximate || map.isPreview());
}

} // namespace marsview
