// marsview.measure: the measurements of the command line, over an open map.
#include "app/console/measure_report.h"
#include "app/console/text_output.h"
#include "app/python/job.h"
#include "app/python/python_map.h"
#include "core/measure/sample_reader.h"
#include "core/measure/terrain_slope.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <pybind11/stl.h>
#include <utility>

namespace marsview::python {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A map and positions on it.
class Measured {
public:
    Measured(const PythonMap& map, const Doubles& points, const std::string& frame)
        : map_(map)
        , terrain_(map.map->georeference(), readSamples(map.map->heightfield()))
    {
        checkRows(points, 2, "points");
        if (frame != "lonlat" && frame != "map") {
            throw py::value_error("frame must be lonlat or map");
        }
        if (frame == "lonlat") {
            map.needsLonLat();
        }
        for (py::ssize_t i = 0; i < points.shape(0); ++i) {
            positions_.push_back(placed(points.at(i, 0), points.at(i, 1), frame == "map",
                                        static_cast<std::size_t>(i) + 1));
        }
    }

    MeasuredTerrain& terrain() { return terrain_; }
    const std::vector<GroundPosition>& positions() const { return positions_; }
    std::vector<GroundPosition> openPositions() const
    {
        std::vector<GroundPosition> open = positions_;
        if (open.size() > 1 && open.front() == open.back()) {
            open.pop_back();
        }
        return open;
    }
    GroundPosition lonLat(GroundPosition position) const
    {
        const auto& ellipsoid = terrain_.ground().ellipsoid();
        if (!ellipsoid) {
            return {kNan, kNan};
        }
        if (map_.latitudeKind() == LatitudeKind::Planetocentric) {
            position.y = ellipsoid->planetocentric(Angle::degrees(position.y)).degrees();
        }
        return position;
    }
    MapPoint toMap(GroundPosition position) const
    {
        return terrain_.toMap(position).value_or(MapPoint{kNan, kNan});
    }

private:
    GroundPosition placed(double x, double y, bool is_map, std::size_t number) const
    {
        if (is_map) {
            const auto position = terrain_.fromMap({x, y});
            if (!position) {
                throw Failure({ErrorCode::OutOfRange,
                               fmt::format("position {} ({}, {}) is outside the map's projection",
                                           number, x, y)});
            }
            return *position;
        }
        if (!(std::abs(y) <= 90.0)) {
            throw Failure({ErrorCode::OutOfRange,
                           fmt::format("position {} has latitude {}, which is outside -90 to 90 "
                                       "degrees; give longitude before latitude",
                                       number, y)});
        }
        if (map_.latitudeKind() == LatitudeKind::Planetographic) {
            return {x, y};
        }
        return {x, terrain_.ground().ellipsoid()->planetographic(Angle::degrees(y)).degrees()};
    }

    const PythonMap& map_;
    MeasuredTerrain terrain_;
    std::vector<GroundPosition> positions_;
};

py::object distance(const PythonMap& map, const Doubles& points, const std::string& frame)
{
    Measured measured(map, points, frame);
    return asPython(reportOf(resultOf<Distance>(py::none(), [&](JobMonitor& monitor) {
        return measureDistance(measured.terrain(), measured.positions(), monitor);
    })));
}

py::dict profile(const PythonMap& map,
                 const Doubles& points,
                 const std::optional<double>& step_m,
                 const std::string& frame)
{
    Measured measured(map, points, frame);
    const auto line = resultOf<Profile>(py::none(), [&](JobMonitor& monitor) {
        return measureProfile(measured.terrain(), measured.positions(), step_m, monitor);
    });
    const auto count = static_cast<py::ssize_t>(line.points.size());
    std::array<py::array_t<double>, 6> columns;
    for (auto& column : columns) {
        column = py::array_t<double>(count);
    }
    for (py::ssize_t i = 0; i < count; ++i) {
        const ProfilePoint& point = line.points[static_cast<std::size_t>(i)];
        const GroundPosition lonlat = measured.lonLat(point.position);
        const MapPoint in_map = measured.toMap(point.position);
        const std::array<double, 6> values{point.distance_m, lonlat.x, lonlat.y,
                                           in_map.x,         in_map.y, point.elevation_m};
        for (std::size_t k = 0; k < values.size(); ++k) {
            columns[k].mutable_at(i) = values[k];
        }
    }
    py::dict result;
    constexpr std::array<const char*, 6> kNames{"distance_m", "lon", "lat",
                                                "x",          "y",   "elevation_m"};
    for (std::size_t k = 0; k < kNames.size(); ++k) {
        result[kNames[k]] = columns[k];
    }
    return result;
}

py::object
area(const PythonMap& map, const Doubles& points, const py::object& base, const std::string& frame)
{
    Measured measured(map, points, frame);
    AreaOptions options;
    if (py::isinstance<py::str>(base)) {
        if (base.cast<std::string>() != "plane") {
            throw py::value_error("base must be an elevation in meters or \"plane\"");
        }
        options.base = VolumeBase::BorderPlane;
    } else if (!base.is_none()) {
        options = {.base = VolumeBase::Elevation, .base_m = base.cast<double>()};
    }
    return asPython(reportOf(resultOf<TerrainArea>(py::none(), [&](JobMonitor& monitor) {
        return measureArea(measured.terrain(), measured.positions(), options, monitor);
    })));
}

py::object attitude(const PythonMap& map,
                    const Doubles& points,
                    const std::optional<double>& elevation_error_m,
                    const std::string& frame)
{
    Measured measured(map, points, frame);
    const auto plane = resultOf<Attitude>(py::none(), [&](JobMonitor&) {
        const double elevation_m = measured.positions().empty()
                                       ? 0.0
                                       : measured.terrain().elevation(measured.positions().front());
        return measureAttitude(
            measured.terrain(), measured.openPositions(),
            {.elevation_error_m = elevation_error_m,
             .default_elevation_error_m = elevationStepError(map.map->info(), elevation_m)});
    });
    return asPython(reportOf(plane, measured.lonLat(measured.terrain().inTurn(plane.center))));
}

py::object crater(const PythonMap& map, const Doubles& points, const std::string& frame)
{
    Measured measured(map, points, frame);
    const auto found = resultOf<Crater>(py::none(), [&](JobMonitor& monitor) {
        return measureCrater(measured.terrain(), measured.openPositions(), monitor);
    });
    return asPython(reportOf(found, measured.lonLat(measured.terrain().inTurn(found.center)),
                             measured.toMap(found.center)));
}

py::dict slope(const PythonMap& map,
               const Doubles& points,
               const std::optional<double>& baseline_m,
               const std::string& frame)
{
    Measured measured(map, points, frame);
    const auto slopes = resultOf<std::vector<TerrainSlope>>(py::none(), [&](JobMonitor& monitor) {
        return measureSlopes(measured.terrain(), measured.positions(), baseline_m, monitor);
    });
    const auto count = static_cast<py::ssize_t>(slopes.size());
    py::array_t<double> elevations(count);
    py::array_t<double> angles(count);
    py::array_t<double> aspects(count);
    for (py::ssize_t i = 0; i < count; ++i) {
        const TerrainSlope& at = slopes[static_cast<std::size_t>(i)];
        elevations.mutable_at(i) = at.elevation_m;
        angles.mutable_at(i) = at.slope_deg;
        aspects.mutable_at(i) = at.aspect_deg;
    }
    py::dict result;
    result["elevation_m"] = elevations;
    result["slope_deg"] = angles;
    result["aspect_deg"] = aspects;
    return result;
}

} // namespace

void addMeasure(py::module_& module)
{
    const auto frame = py::arg("frame") = "lonlat";
    module.def("distance", &distance, py::arg("map"), py::arg("points"), frame);
    module.def("profile", &profile, py::arg("map"), py::arg("points"),
               py::arg("step_m") = py::none(), frame);
    module.def("area", &area, py::arg("map"), py::arg("points"), py::arg("base") = py::none(),
               frame);
    module.def("attitude", &attitude, py::arg("map"), py::arg("points"),
               py::arg("elevation_error_m") = py::none(), frame);
    module.def("crater", &crater, py::arg("map"), py::arg("points"), frame);
    module.def("slope", &slope, py::arg("map"), py::arg("points"),
               py::arg("baseline_m") = py::none(), frame);
}

} // namespace marsview::python
