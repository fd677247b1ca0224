#include "app/python/python_map.h"

#include "app/console/map_report.h"
#include "app/console/picture.h"
#include "app/python/job.h"
#include "core/measure/sample_reader.h"
#include "core/prepare/map_folder.h"
#include "core/prepare/prepare_map.h"
#include "core/session/open_map.h"
#include "core/terrain/seam.h"
#include "core/terrain/triangulation.h"
#include "core/view/color_ramp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <pybind11/stl.h>
#include <utility>

namespace marsview::python {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> numbersIn(const py::handle& value)
{
    return py::isinstance<py::float_>(value) || py::isinstance<py::int_>(value)
               ? std::vector<double>{value.cast<double>()}
               : value.cast<std::vector<double>>();
}

std::string pathFrom(const py::object& path)
{
    return py::module_::import("os").attr("fsencode")(path).cast<std::string>();
}

// Elevations of the triangulated surface at positions anywhere; waits for tiles.
class Surface {
public:
    explicit Surface(const Map& map)
        : map_(map)
        , samples_(readSamples(map.heightfield()))
    {}

    double at(GridPoint grid) const
    {
        const Heightfield& heightfield = map_.heightfield();
        if (!heightfield.isTiled()) {
            return heightfield.height(grid);
        }
        const double last_column = static_cast<double>(heightfield.columns() - 1);
        const double last_row = static_cast<double>(heightfield.rows() - 1);
        if (!(grid.column >= 0.0 && grid.column <= last_column && grid.row >= 0.0 &&
              grid.row <= last_row)) {
            return kNan;
        }
        const double c = std::min(std::floor(grid.column), last_column - 1.0);
        const double r = std::min(std::floor(grid.row), last_row - 1.0);
        const auto column = static_cast<std::size_t>(c);
        return heightInCell(cell(column, column + 1, static_cast<std::size_t>(r)), grid.column - c,
                            grid.row - r);
    }
    double at(GeographicPoint point) const
    {
        const Heightfield& heightfield = map_.heightfield();
        if (!heightfield.isTiled()) {
            return map_.height(point);
        }
        const auto grid = map_.georeference().toGrid(point);
        if (!grid) {
            return kNan;
        }
        if (map_.georeference().wrapsAround()) {
            if (const auto seam = seamCell(*grid, heightfield.columns(), heightfield.rows())) {
                return heightInCell(cell(heightfield.columns() - 1, 0, seam->row), seam->u,
                                    seam->v);
            }
        }
        return at(*grid);
    }
    const std::optional<Error>& failure() const { return samples_->failure(); }

private:
    CellHeights cell(std::size_t left, std::size_t right, std::size_t row) const
    {
        return {samples_->sample(left, row), samples_->sample(right, row),
                samples_->sample(left, row + 1), samples_->sample(right, row + 1)};
    }

    const Map& map_;
    std::unique_ptr<SampleReader> samples_;
};

// Elevations at the places of pairs of numbers, which may be arrays that broadcast.
template <typename Place>
py::object
elevations(const PythonMap& self, const py::object& first, const py::object& second, Place place)
{
    const py::module_ numpy = py::module_::import("numpy");
    const auto is_number = [&numpy](const py::object& value) {
        return numpy.attr("ndim")(value).cast<int>() == 0;
    };
    const py::sequence pair = numpy.attr("broadcast_arrays")(first, second);
    const Doubles a = Doubles::ensure(pair[0]);
    const Doubles b = Doubles::ensure(pair[1]);
    if (!a || !b) {
        throw py::error_already_set();
    }
    py::array_t<double> heights(std::vector<py::ssize_t>(a.shape(), a.shape() + a.ndim()));
    const double* first_value = a.data();
    const double* second_value = b.data();
    double* height = heights.mutable_data();
    const py::ssize_t count = a.size();
    std::optional<Error> failure;
    {
        const py::gil_scoped_release released;
        const Surface surface(*self.map);
        for (py::ssize_t i = 0; i < count; ++i) {
            height[i] = surface.at(place(first_value[i], second_value[i]));
        }
        failure = surface.failure();
    }
    if (failure) {
        throw Failure(*failure);
    }
    if (is_number(first) && is_number(second)) {
        return py::float_(*heights.data());
    }
    return heights;
}

py::object elevation(const PythonMap& self, const py::object& lon, const py::object& lat)
{
    self.needsLonLat();
    if (self.latitudeKind() == LatitudeKind::Planetocentric) {
        return elevations(self, lon, lat, [](double x, double y) {
            return GeographicPoint{Angle::degrees(x), Angle::degrees(y)};
        });
    }
    const Ellipsoid ellipsoid = *self.map->info().crs->ellipsoid();
    return elevations(self, lon, lat, [&ellipsoid](double x, double y) {
        return GeographicPoint{Angle::degrees(x), ellipsoid.planetocentric(Angle::degrees(y))};
    });
}

py::object elevationMap(const PythonMap& self, const py::object& x, const py::object& y)
{
    return elevations(self, x, y, [&self](double east, double north) {
        return self.map->georeference().toGrid(MapPoint{east, north});
    });
}

py::array_t<double> samplesOf(const PythonMap& self,
                              const std::optional<std::array<std::size_t, 4>>& window)
{
    const Heightfield& heightfield = self.map->heightfield();
    const auto [column, row, columns, rows] = window.value_or(
        std::array<std::size_t, 4>{0, 0, heightfield.columns(), heightfield.rows()});
    if (columns == 0 || rows == 0 || column >= heightfield.columns() || row >= heightfield.rows() ||
        columns > heightfield.columns() - column || rows > heightfield.rows() - row) {
        throw Failure({ErrorCode::OutOfRange,
                       fmt::format("window: columns {} to {} and rows {} to {} are not all on the "
                                   "map of {} × {} samples",
                                   column, column + columns, row, row + rows, heightfield.columns(),
                                   heightfield.rows())});
    }
    py::array_t<double> samples(
        {static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns)});
    double* to = samples.mutable_data();
    std::optional<Error> failure;
    {
        const py::gil_scoped_release released;
        const auto reader = readSamples(heightfield);
        for (std::size_t r = row; r < row + rows; ++r) {
            for (std::size_t c = column; c < column + columns; ++c) {
                *to++ = reader->sample(c, r);
            }
        }
        failure = reader->failure();
    }
    if (failure) {
        throw Failure(*failure);
    }
    return samples;
}

py::object infoOf(const PythonMap& self)
{
    const Heightfield& heightfield = self.map->heightfield();
    nlohmann::ordered_json report = mapReport(self.map->info(), std::nullopt, self.latitudeKind());
    for (const char* unknown : {"void_count", "raw_minimum", "raw_maximum"}) {
        report.erase(unknown);
    }
    if (const auto range = heightfield.range()) {
        report["minimum"] = range->minimum_m;
        report["maximum"] = range->maximum_m;
    }
    return asPython(report);
}

struct RenderArguments {
    std::pair<int, int> size{1280, 800};
    std::optional<std::pair<double, double>> look_at{};
    std::optional<double> distance_m{};
    double azimuth_deg = 0.0;
    std::optional<double> tilt_deg{};
    std::optional<double> exaggeration{};
    double error_px = 1.0;
    std::optional<int> samples;
    std::string shading = "tint";
    std::string ramp;
    std::pair<double, double> light_deg{315.0, 45.0};
    bool contours = false;
};

void refuseUnless(bool is_fine, const std::string& why)
{
    if (!is_fine) {
        throw py::value_error(why);
    }
}

py::array_t<std::uint8_t> render(const PythonMap& self, const RenderArguments& wanted)
{
    const auto is_positive = [](const std::optional<double>& value) {
        return !value || (std::isfinite(*value) && *value > 0.0);
    };
    constexpr int kSideMax = 16384;
    refuseUnless(wanted.size.first >= 1 && wanted.size.second >= 1 &&
                     wanted.size.first <= kSideMax && wanted.size.second <= kSideMax,
                 "size: width and height must be 1 to 16384 pixels");
    refuseUnless(is_positive(wanted.distance_m), "distance_m must be positive");
    refuseUnless(is_positive(wanted.exaggeration), "exaggeration must be positive");
    refuseUnless(is_positive(wanted.error_px), "error_px must be positive");
    refuseUnless(std::isfinite(wanted.azimuth_deg), "azimuth_deg must be finite");
    refuseUnless(!wanted.tilt_deg || (*wanted.tilt_deg >= 0.0 && *wanted.tilt_deg <= 85.0),
                 "tilt_deg must be 0 to 85");
    refuseUnless(!wanted.samples || (*wanted.samples >= 1 && *wanted.samples <= 16),
                 "samples must be 1 to 16");
    refuseUnless(wanted.shading == "tint" || wanted.shading == "hillshade" ||
                     wanted.shading == "slope",
                 "shading must be tint, hillshade or slope");
    const ColorRamp* ramp = wanted.ramp.empty() ? nullptr : colorRampNamed(wanted.ramp);
    refuseUnless(ramp != nullptr || wanted.ramp.empty(),
                 fmt::format("ramp: there is no color ramp \"{}\"", wanted.ramp));
    PictureOptions options{
        .viewport = {.width = wanted.size.first, .height = wanted.size.second},
        .distance_m = wanted.distance_m,
        .azimuth_deg = wanted.azimuth_deg,
        .tilt_deg = wanted.tilt_deg,
        .exaggeration = wanted.exaggeration,
        .error_px = wanted.error_px,
        .samples = wanted.samples,
        .shading = wanted.shading == "tint"        ? ShadingMode::Tint
                   : wanted.shading == "hillshade" ? ShadingMode::Hillshade
                                                   : ShadingMode::Slope,
        .light_deg = {wanted.light_deg.first, wanted.light_deg.second},
        .has_contours = wanted.contours,
    };
    if (wanted.look_at) {
        options.look_at = MapPoint{wanted.look_at->first, wanted.look_at->second};
    }
    // The context belongs to the thread that draws, and ends with it.
    const auto picture = resultOf<Picture>(py::none(), [&](JobMonitor& monitor) -> Result<Picture> {
        Result<Scene> scene = emptyScene();
        if (!scene) {
            return std::move(scene).error();
        }
        if (monitor.isCanceled()) {
            return Error{ErrorCode::Canceled, "canceled"};
        }
        showIn(*scene, self.map, ramp);
        Result<OffscreenPicture> drawn = drawPicture(*scene, options);
        if (!drawn) {
            return std::move(drawn).error();
        }
        return std::move(drawn->colors);
    });
    py::array_t<std::uint8_t> pixels({static_cast<py::ssize_t>(picture.height),
                                      static_cast<py::ssize_t>(picture.width), py::ssize_t{3}});
    std::memcpy(pixels.mutable_data(), picture.rgb.data(), picture.rgb.size());
    return pixels;
}

PythonMap open(const py::object& path, const py::kwargs& overrides)
{
    PythonMap opened{.options = mapOptionsFrom(pathFrom(path), overrides), .map = {}};
    opened.map = resultOf<std::shared_ptr<const Map>>(py::none(), [&](JobMonitor& monitor) {
        return openMap(opened.options.spec(), sharedResources(), monitor);
    });
    return opened;
}

py::dict prepare(const py::object& path,
                 const py::object& output,
                 const py::object& progress,
                 const py::kwargs& overrides)
{
    const MapOptions options = mapOptionsFrom(pathFrom(path), overrides);
    const std::string raster_path = output.is_none() ? std::string() : pathFrom(output);
    const auto report =
        resultOf<PrepareReport>(progress, [&](JobMonitor& monitor) -> Result<PrepareReport> {
            const Result<OpenRaster> raster = openRaster(options.spec());
            if (!raster) {
                return raster.error();
            }
            if (!raster_path.empty() || canBeUsedInPlace(*raster)) {
                return prepareMapFiles(
                    *raster,
                    {.raster_path = raster_path, .when_there = PrepareJob::WhenThere::Check},
                    monitor);
            }
            if (Status local = checkIsLocal(options.spec()); !local) {
                return std::move(local).error();
            }
            return prepareInFolder(
                *raster,
                {.folder = MapFolder::defaultPath(), .when_there = PrepareJob::WhenThere::Check},
                monitor);
        });
    py::dict result;
    result["file"] = asPython(report.raster_path);
    result["level_file"] = asPython(report.level_path);
    result["samples"] = report.samples;
    result["seconds"] = report.copy_seconds + report.level_seconds + report.check_seconds;
    result["notes"] = report.notes;
    return result;
}

} // namespace

const MapResources& sharedResources()
{
    static const MapResources resources = defaultMapResources();
    return resources;
}

MapOptions mapOptionsFrom(const std::string& path, const py::kwargs& overrides)
{
    MapOptions options;
    options.path = path;
    for (const auto& [key, value] : overrides) {
        const auto name = key.cast<std::string>();
        if (value.is_none()) {
            continue;
        }
        if (name == "band") {
            options.band = value.cast<int>();
        } else if (name == "crs") {
            options.crs = value.cast<std::string>();
        } else if (name == "body") {
            options.body = value.cast<std::string>();
        } else if (name == "radii_m") {
            options.radii_m = numbersIn(value);
            refuseUnless(options.radii_m.size() == 1 || options.radii_m.size() == 2,
                         "radii_m must be one or two numbers");
        } else if (name == "geotransform") {
            options.geotransform = numbersIn(value);
            refuseUnless(options.geotransform.size() == 6, "geotransform must be six numbers");
        } else if (name == "vertical_unit") {
            options.vertical_unit = value.cast<std::string>();
        } else if (name == "scale") {
            options.scale = value.cast<double>();
        } else if (name == "offset") {
            options.offset = value.cast<double>();
        } else if (name == "vertical_datum") {
            options.vertical_datum = value.cast<std::string>();
        } else if (name == "nodata") {
            options.nodata = value.cast<double>();
        } else if (name == "latitude") {
            options.latitude = value.cast<std::string>();
            refuseUnless(options.latitude == "planetocentric" ||
                             options.latitude == "planetographic",
                         "latitude must be planetocentric or planetographic");
        } else {
            throw py::type_error(fmt::format("unknown argument \"{}\"", name));
        }
    }
    return options;
}

void PythonMap::needsLonLat() const
{
    const auto& crs = map->info().crs;
    if (!crs || crs->kind() == CrsKind::Local) {
        throw Failure({ErrorCode::Invalid,
                       fmt::format("{}: has no CRS, so it has no longitude and latitude; set one "
                                   "with crs or body",
                                   options.path)});
    }
}

void addMap(py::module_& module)
{
    py::class_<PythonMap>(module, "Map")
        .def_property_readonly("info", &infoOf)
        .def_property_readonly("shape",
                               [](const PythonMap& self) {
                                   return py::make_tuple(self.map->heightfield().rows(),
                                                         self.map->heightfield().columns());
                               })
        .def("elevation", &elevation, py::arg("lon"), py::arg("lat"))
        .def("elevation_map", &elevationMap, py::arg("x"), py::arg("y"))
        .def("array", &samplesOf, py::arg("window") = py::none())
        .def(
            "render",
            [](const PythonMap& self, std::pair<int, int> size,
               std::optional<std::pair<double, double>> look_at, std::optional<double> distance_m,
               double azimuth_deg, std::optional<double> tilt_deg,
               std::optional<double> exaggeration, double error_px, std::optional<int> samples,
               const std::string& shading, const std::optional<std::string>& ramp,
               std::pair<double, double> light_deg, bool contours) {
                return render(self,
                              {size, look_at, distance_m, azimuth_deg, tilt_deg, exaggeration,
                               error_px, samples, shading, ramp.value_or(""), light_deg, contours});
            },
            py::kw_only(), py::arg("size") = std::pair(1280, 800), py::arg("look_at") = py::none(),
            py::arg("distance_m") = py::none(), py::arg("azimuth_deg") = 0.0,
            py::arg("tilt_deg") = py::none(), py::arg("exaggeration") = py::none(),
            py::arg("error_px") = 1.0, py::arg("samples") = py::none(), py::arg("shading") = "tint",
            py::arg("ramp") = py::none(), py::arg("light_deg") = std::pair(315.0, 45.0),
            py::arg("contours") = false)
        .def("__repr__", [](const PythonMap& self) {
            const Heightfield& heightfield = self.map->heightfield();
            const Body* body = self.map->info().body;
            return asPython(
                fmt::format("<marsview.Map {}: {} × {} samples{}>", self.options.path,
                            heightfield.columns(), heightfield.rows(),
                            body != nullptr ? fmt::format(", {}", body->name) : std::string()));
        });
    module.def("open", &open, py::arg("path"));
    module.def("prepare", &prepare, py::arg("path"), py::arg("output") = py::none(),
               py::arg("progress") = py::none());
}

} // namespace marsview::python
