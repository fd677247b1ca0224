#include "core/session/project.h"

#include "core/annotations/drawn_json.h"
#include "core/base/durable_file.h"
#include "core/files/raster_path.h"
#include "core/json/json_members.h"
#include "core/session/project_views.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFormat = "MarsView project";
constexpr std::uintmax_t kBytesMax = std::uintmax_t{1} << 30;
constexpr std::size_t kLayersMax = 100000;
constexpr std::size_t kDrawnMax = 1000000; // measurements, annotations
constexpr std::size_t kViewsMax = 100000;
constexpr int kIndent = 2;

constexpr std::array kShadings{
    Named<ShadingMode>{ShadingMode::Tint, "shaded relief"},
    Named<ShadingMode>{ShadingMode::Hillshade, "hillshade"},
    Named<ShadingMode>{ShadingMode::Slope, "slope"},
};
constexpr std::array kStretches{
    Named<StretchKind>{StretchKind::Automatic, "automatic"},
    Named<StretchKind>{StretchKind::Full, "full"},
    Named<StretchKind>{StretchKind::Percentile, "percentile"},
    Named<StretchKind>{StretchKind::Fixed, "fixed"},
};

constexpr std::array kLightFrames{
    Named<LightFrame>{LightFrame::View, "fixed in the view"},
    Named<LightFrame>{LightFrame::Body, "fixed on the body"},
};

constexpr std::array kOrders{
    Named<LayerOrder>{LayerOrder::Listed, "listed"},
    Named<LayerOrder>{LayerOrder::FinestFirst, "finest first"},
};

constexpr std::array kScenes{
    Named<SceneChoice>{SceneChoice::Automatic, "automatic"},
    Named<SceneChoice>{SceneChoice::Flat, "flat map"},
    Named<SceneChoice>{SceneChoice::Globe, "globe"},
};

constexpr std::array kMeasurements{
    Named<MeasurementKind>{MeasurementKind::Distance, "distance"},
    Named<MeasurementKind>{MeasurementKind::Area, "area"},
    Named<MeasurementKind>{MeasurementKind::Profile, "profile"},
    Named<MeasurementKind>{MeasurementKind::Attitude, "attitude"},
    Named<MeasurementKind>{MeasurementKind::Crater, "crater"},
    Named<MeasurementKind>{MeasurementKind::Slope, "point"},
};

// JSON has no names for these values.
Json numberJson(double value)
{
    if (std::isnan(value)) {
        return "nan";
    }
    if (std::isinf(value)) {
        return value > 0.0 ? "inf" : "-inf";
    }
    return value;
}

// Whether `path` is below `folder` at any depth. Both are absolute and normal.
bool isBelow(const fs::path& path, const fs::path& folder)
{
    const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return end == folder.end() || (end->empty() && std::next(end) == folder.end());
}

void putSource(Json& layer, const std::string& path, const ProjectFolders& folders)
{
    if (isGdalName(path)) {
        layer["dataset"] = path;
        return;
    }
    const fs::path file = fs::absolute(path).lexically_normal();
    if (!folders.bundled.empty() && isBelow(file, folders.bundled.lexically_normal())) {
        layer["bundled"] =
            file.lexically_relative(folders.bundled.lexically_normal()).generic_string();
        return;
    }
    const fs::path folder = (folders.project / "").lexically_normal().parent_path();
    const fs::path parent = folder.parent_path();
    const bool is_near =
        isBelow(file, folder) ||
        (parent != folder && parent != parent.root_path() && isBelow(file, parent));
    layer["file"] = is_near ? file.lexically_relative(folder).generic_string() : file.string();
}

Json overridesJson(const RasterOverrides& overrides)
{
    Json json = Json::object();
    if (overrides.crs) {
        json["crs"] = *overrides.crs;
    }
    if (overrides.body) {
        json["body"] = *overrides.body;
    }
    if (overrides.ellipsoid) {
        json["equatorial_radius_m"] = numberJson(overrides.ellipsoid->equatorial_m);
        json["polar_radius_m"] = numberJson(overrides.ellipsoid->polar_m);
    }
    if (overrides.transform) {
        Json terms = Json::array();
        for (const double term : *overrides.transform) {
            terms.push_back(numberJson(term));
        }
        json["geotransform"] = std::move(terms);
    }
    if (overrides.vertical_unit) {
        json["vertical_unit"] = *overrides.vertical_unit;
    }
    if (overrides.scale) {
        json["scale"] = numberJson(*overrides.scale);
    }
    if (overrides.offset) {
        json["offset"] = numberJson(*overrides.offset);
    }
    if (overrides.vertical_datum) {
        json["vertical_datum"] = *overrides.vertical_datum;
    }
    if (overrides.nodata) {
        json["nodata"] = numberJson(*overrides.nodata);
    }
    return json;
}

Json layerJson(const LayerRecord& layer, const ProjectFolders& folders)
{
    Json json = Json::object();
    json["name"] = layer.name;
    putSource(json, layer.spec.path, folders);
    json["band"] = layer.spec.band;
    json["visible"] = layer.is_visible;
    json["exaggeration"] = layer.exaggeration;
    json["ramp"] = layer.ramp;
    Json stretch = Json::object();
    stretch["kind"] = nameIn(kStretches, layer.stretch.kind);
    stretch["cut_percent"] = layer.stretch.cut_percent;
    stretch["low_m"] = numberJson(layer.stretch.low);
    stretch["high_m"] = numberJson(layer.stretch.high);
    json["stretch"] = std::move(stretch);
    if (layer.slope_range) {
        json["slope_range"] = {{"minimum_deg", degreesOf(layer.slope_range->minimum)},
                               {"maximum_deg", degreesOf(layer.slope_range->maximum)}};
    }
    if (layer.feather_cells > 0) {
        json["feather_cells"] = layer.feather_cells;
    }
    if (!layer.spec.overrides.isEmpty()) {
        json["overrides"] = overridesJson(layer.spec.overrides);
    }
    return json;
}

Json cameraJson(const ProjectCamera& camera)
{
    Json json = Json::object();
    json["x"] = camera.x;
    json["y"] = camera.y;
    json["elevation_m"] = camera.elevation_m;
    json["distance_m"] = camera.distance_m;
    json["azimuth_deg"] = degreesOf(camera.azimuth);
    json["tilt_deg"] = degreesOf(camera.tilt);
    json["field_of_view_deg"] = degreesOf(camera.field_of_view);
    return json;
}

Json measurementJson(const ProjectMeasurement& measurement)
{
    Json json = Json::object();
    json["name"] = measurement.name;
    if (!measurement.note.empty()) {
        json["note"] = measurement.note;
    }
    if (measurement.color) {
        json["color"] = colorText(*measurement.color);
    }
    json["kind"] = nameIn(kMeasurements, measurement.kind);
    if (measurement.layer) {
        json["layer"] = *measurement.layer;
    }
    json["time"] = timeText(measurement.time);
    putVertices(json, measurement.vertices);
    return json;
}

Json overlayJson(const VectorOverlay& overlay, const ProjectFolders& folders)
{
    Json json = Json::object();
    putSource(json, overlay.path, folders);
    json["color"] = colorText(overlay.color);
    json["visible"] = overlay.is_visible;
    if (!overlay.crs.empty()) {
        json["crs"] = overlay.crs;
    }
    return json;
}

Json lookJson(const TerrainLook& look)
{
    Json json = Json::object();
    json["shading"] = nameIn(kShadings, look.mode);
    json["contours"] = look.has_contours;
    json["contour_interval_m"] = look.contour_interval_m;
    json["light_azimuth_deg"] = degreesOf(look.light_azimuth);
    json["light_altitude_deg"] = degreesOf(look.light_altitude);
    if (look.light_frame != LightFrame::View) {
        json["light"] = nameIn(kLightFrames, look.light_frame);
    }
    if (look.subsolar) {
        json["subsolar_longitude_deg"] = degreesOf(look.subsolar->longitude);
        json["subsolar_latitude_deg"] = degreesOf(look.subsolar->latitude);
    }
    return json;
}

std::string pathFrom(Members& members, const ProjectFolders& folders)
{
    std::string file;
    std::string bundled;
    std::string dataset;
    members.text("file", file);
    members.text("bundled", bundled);
    members.text("dataset", dataset);
    if (!dataset.empty()) {
        return dataset;
    }
    if (!bundled.empty()) {
        return (folders.bundled / bundled).lexically_normal().string();
    }
    if (file.empty()) {
        members.refuse("file", "the path of a file");
        return {};
    }
    return (folders.project / file).lexically_normal().string();
}

RasterOverrides overridesFrom(Members& members)
{
    RasterOverrides overrides;
    members.text("crs", overrides.crs);
    members.text("body", overrides.body);
    if (members.has("equatorial_radius_m") || members.has("polar_radius_m")) {
        std::optional<double> equatorial;
        std::optional<double> polar;
        members.anyNumber("equatorial_radius_m", equatorial);
        members.anyNumber("polar_radius_m", polar);
        overrides.ellipsoid = Ellipsoid{equatorial.value_or(polar.value_or(0.0)),
                                        polar.value_or(equatorial.value_or(0.0))};
    }
    members.terms("geotransform", overrides.transform);
    members.text("vertical_unit", overrides.vertical_unit);
    members.anyNumber("scale", overrides.scale);
    members.anyNumber("offset", overrides.offset);
    members.text("vertical_datum", overrides.vertical_datum);
    members.anyNumber("nodata", overrides.nodata);
    return overrides;
}

ColorStretch stretchFrom(Members& members)
{
    ColorStretch stretch;
    members.choice("kind", kStretches, stretch.kind);
    members.number(
        "cut_percent", stretch.cut_percent,
        [](double cut) { return cut >= 0.0 && cut <= kStretchCutMax; },
        "a percentage from 0 to 45");
    members.number("low_m", stretch.low);
    members.number("high_m", stretch.high);
    if (stretch.kind == StretchKind::Fixed && !isStretchRange(stretch.low, stretch.high)) {
        members.refuse("high_m", "greater than low_m");
    }
    return stretch;
}

SlopeRange slopeRangeFrom(Members& members)
{
    SlopeRange range;
    const auto is_slope = [](double degrees) { return degrees >= 0.0 && degrees <= 90.0; };
    members.angle("minimum_deg", range.minimum, is_slope, "a slope from 0 to 90");
    members.angle("maximum_deg", range.maximum, is_slope, "a slope from 0 to 90");
    if (!(range.minimum < range.maximum)) {
        members.refuse("maximum_deg", "greater than minimum_deg");
    }
    return range;
}

LayerRecord layerFrom(Members& members, const ProjectFolders& folders)
{
    LayerRecord layer;
    members.text("name", layer.name);
    layer.spec.path = pathFrom(members, folders);
    members.count("band", layer.spec.band);
    members.flag("visible", layer.is_visible);
    members.number(
        "exaggeration", layer.exaggeration, [](double factor) { return factor >= 0.0; },
        "a factor");
    members.text("ramp", layer.ramp);
    members.object("stretch", [&](Members& stretch) { layer.stretch = stretchFrom(stretch); });
    members.object("slope_range",
                   [&](Members& range) { layer.slope_range = slopeRangeFrom(range); });
    static_assert(kFeatherCellsMax == 200);
    int feather_cells = 0;
    members.count("feather_cells", feather_cells);
    if (feather_cells > static_cast<int>(kFeatherCellsMax)) {
        members.refuse("feather_cells", "a whole number up to 200");
        feather_cells = 0;
    }
    layer.feather_cells = static_cast<std::size_t>(feather_cells);
    members.object("overrides",
                   [&](Members& overrides) { layer.spec.overrides = overridesFrom(overrides); });
    return layer;
}

TerrainLook lookFrom(Members& members)
{
    TerrainLook look;
    members.choice("shading", kShadings, look.mode);
    members.flag("contours", look.has_contours);
    members.number(
        "contour_interval_m", look.contour_interval_m,
        [](double interval) { return interval >= 0.0; }, "a length");
    members.angle(
        "light_azimuth_deg", look.light_azimuth, [](double) { return true; }, "an angle");
    members.angle(
        "light_altitude_deg", look.light_altitude,
        [](double degrees) { return degrees >= -90.0 && degrees <= 90.0; },
        "an angle from -90 to 90");
    members.choice("light", kLightFrames, look.light_frame);
    if (members.has("subsolar_longitude_deg") || members.has("subsolar_latitude_deg")) {
        look.subsolar.emplace();
        members.angle(
            "subsolar_longitude_deg", look.subsolar->longitude, [](double) { return true; },
            "an angle");
        members.angle(
            "subsolar_latitude_deg", look.subsolar->latitude,
            [](double degrees) { return degrees >= -90.0 && degrees <= 90.0; },
            "a latitude from -90 to 90");
    }
    return look;
}

ProjectCamera cameraFrom(Members& members)
{
    ProjectCamera camera;
    members.number("x", camera.x);
    members.number("y", camera.y);
    members.number("elevation_m", camera.elevation_m);
    members.number(
        "distance_m", camera.distance_m, [](double distance) { return distance > 0.0; },
        "a length above 0");
    members.angle(
        "azimuth_deg", camera.azimuth, [](double) { return true; }, "an angle");
    members.angle(
        "tilt_deg", camera.tilt, [](double degrees) { return degrees >= 0.0 && degrees <= 90.0; },
        "an angle from 0 to 90");
    members.angle(
        "field_of_view_deg", camera.field_of_view,
        [](double degrees) { return degrees > 0.0 && degrees < 180.0; },
        "an angle between 0 and 180");
    return camera;
}

ProjectMeasurement measurementFrom(Members& members, std::size_t layer_count)
{
    ProjectMeasurement measurement;
    members.text("name", measurement.name);
    members.choice("kind", kMeasurements, measurement.kind);
    members.index("layer", measurement.layer, layer_count);
    members.text("note", measurement.note);
    measurement.color = colorFrom(members);
    measurement.time = timeFrom(members);
    measurement.vertices = verticesFrom(members);
    return measurement;
}

VectorOverlay overlayFrom(Members& members, const ProjectFolders& folders)
{
    VectorOverlay overlay;
    overlay.path = pathFrom(members, folders);
    if (const auto color = colorFrom(members)) {
        overlay.color = *color;
    }
    members.flag("visible", overlay.is_visible);
    members.text("crs", overlay.crs);
    return overlay;
}

// Annotations as projectText() has them: a document of a million takes gigabytes, so that each is
// made and written alone.
std::string annotationsText(const std::vector<ProjectAnnotation>& annotations, JobMonitor& monitor)
{
    std::string text = "[";
    for (std::size_t i = 0; i < annotations.size() && !monitor.isCanceled(); ++i) {
        const ProjectAnnotation& drawn = annotations[i];
        monitor.report(static_cast<double>(i) / static_cast<double>(annotations.size()));
        Json annotation = annotationJson(drawn.annotation);
        if (drawn.layer) {
            annotation["layer"] = *drawn.layer;
        }
        text += text.size() > 1 ? ",\n    " : "\n    ";
        for (const char letter : annotation.dump(kIndent)) {
            text += letter;
            if (letter == '\n') {
                text += "    ";
            }
        }
    }
    return text + "\n  ]";
}

// Takes the annotations out of a document while it is being parsed, for the same reason.
class AnnotationTaker {
public:
    // For the parser: whether a value stays in the document.
    bool operator()(int depth, Json::parse_event_t event, const Json& value)
    {
        if (event == Json::parse_event_t::key && depth == 1) {
            is_inside_ = value == "annotations";
        }
        if (!is_inside_ || event != Json::parse_event_t::object_end || depth != 2) {
            return true;
        }
        if (++count_ <= kDrawnMax) {
            Members members(value, fmt::format("annotations[{}]", count_ - 1), fault_);
            ProjectAnnotation drawn{.annotation = annotationFrom(members)};
            members.index("layer", drawn.layer, std::numeric_limits<std::size_t>::max());
            annotations_.push_back(std::move(drawn));
        }
        return false;
    }

    // Once the layers are known.
    std::vector<ProjectAnnotation> take(std::size_t layer_count, std::string& fault)
    {
        for (std::size_t i = 0; i < annotations_.size() && fault_.empty(); ++i) {
            if (annotations_[i].layer && *annotations_[i].layer >= layer_count) {
                fault_ = fmt::format("annotations[{}].layer is not the index of a layer", i);
            }
        }
        if (count_ > kDrawnMax && fault_.empty()) {
            fault_ = "annotations is not a list of annotations";
        }
        if (fault.empty()) {
            fault = fault_;
        }
        return std::move(annotations_);
    }

private:
    bool is_inside_ = false;
    std::size_t count_ = 0;
    std::string fault_;
    std::vector<ProjectAnnotation> annotations_;
};

// A text that is being parsed: reports how much of it has been, and ends early when canceled.
struct ParsedText {
    std::string_view text;
    JobMonitor& monitor;
    bool is_canceled = false;

    void note(std::size_t position)
    {
        constexpr std::size_t kBytes = 1U << 16; // between two reports
        if (position % kBytes == 0) {
            monitor.report(static_cast<double>(position) / static_cast<double>(text.size()));
            is_canceled = monitor.isCanceled();
        }
    }
};

class ParsedLetter {
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    ParsedLetter(ParsedText& of, std::size_t position)
        : of_(&of)
        , position_(position)
    {}
    const char& operator*() const { return of_->text[position_]; }
    ParsedLetter& operator++()
    {
        of_->note(++position_);
        return *this;
    }
    bool operator==(const ParsedLetter& other) const
    {
        return position_ == other.position_ || of_->is_canceled;
    }

private:
    ParsedText* of_;
    std::size_t position_;
};

constexpr std::array kKnownMembers{
    "format", "version", "active",       "look",        "camera",   "scene",      "globe_camera",
    "layers", "views",   "measurements", "annotations", "overlays", "layer_order"};

} // namespace

std::vector<LayerId> projectOrder(const Session& session)
{
    std::vector<LayerId> order;
    for (const Layer& layer : session.layers) {
        order.push_back(layer.id);
    }
    for (const MissingLayer& missing : session.missing) {
        const std::size_t index = std::min(missing.index, order.size());
        order.insert(order.begin() + static_cast<std::ptrdiff_t>(index), missing.id);
    }
    return order;
}

Project projectOf(const Session& session)
{
    Project project;
    for (const LayerId id : projectOrder(session)) {
        if (const Layer* layer = layerOf(session, id)) {
            if (id == session.active) {
                project.active = project.layers.size();
            }
            project.layers.push_back(recordOf(*layer));
            continue;
        }
        const auto missing =
            std::find_if(session.missing.begin(), session.missing.end(),
                         [id](const MissingLayer& candidate) { return candidate.id == id; });
        project.layers.push_back(missing->record);
    }
    project.overlays = session.overlays;
    project.views = projectViews(session.views, projectOrder(session));
    project.look = session.look;
    project.order = session.order;
    return project;
}

namespace {

Result<std::string>
textOf(const Project& project, const ProjectFolders& folders, JobMonitor& monitor)
{
    Json json = Json::object();
    json["format"] = kFormat;
    json["version"] = kProjectVersion;
    if (project.active) {
        json["active"] = *project.active;
    }
    json["look"] = lookJson(project.look);
    if (project.order != LayerOrder::Listed) {
        json["layer_order"] = nameIn(kOrders, project.order);
    }
    if (project.camera) {
        json["camera"] = cameraJson(*project.camera);
    }
    if (project.scene != SceneChoice::Automatic) {
        json["scene"] = nameIn(kScenes, project.scene);
    }
    if (project.globe_camera) {
        putCamera(json["globe_camera"], *project.globe_camera);
    }
    Json layers = Json::array();
    for (const LayerRecord& layer : project.layers) {
        layers.push_back(layerJson(layer, folders));
    }
    json["layers"] = std::move(layers);
    if (!project.overlays.empty()) {
        Json overlays = Json::array();
        for (const VectorOverlay& overlay : project.overlays) {
            overlays.push_back(overlayJson(overlay, folders));
        }
        json["overlays"] = std::move(overlays);
    }
    if (!project.views.empty()) {
        Json views = Json::array();
        for (const ProjectView& view : project.views) {
            views.push_back(viewJson(view));
        }
        json["views"] = std::move(views);
    }
    if (!project.measurements.empty()) {
        Json measurements = Json::array();
        for (const ProjectMeasurement& measurement : project.measurements) {
            measurements.push_back(measurementJson(measurement));
        }
        json["measurements"] = std::move(measurements);
    }
    if (!project.annotations.empty()) {
        json["annotations"] = Json::array();
    }
    for (const auto& [key, text] : project.others) {
        json[key] = Json::parse(text, nullptr, false);
    }
    try {
        std::string text = json.dump(kIndent) + "\n";
        if (!project.annotations.empty()) {
            const std::string empty = "\n  \"annotations\": []"; // texts have no line breaks
            text.replace(text.find(empty) + empty.size() - 2, 2,
                         annotationsText(project.annotations, monitor));
        }
        return text;
    } catch (const Json::type_error&) {
        return Error{
            ErrorCode::Invalid,
            "a layer, a view, a measurement or an annotation has a name or path that is not UTF-8; "
            "rename it"};
    }
}

} // namespace

Result<std::string> projectText(const Project& project, const ProjectFolders& folders)
{
    JobMonitor monitor;
    return textOf(project, folders, monitor);
}

namespace {

Result<Project> projectIn(std::string_view text,
                          const ProjectFolders& folders,
                          const std::string& name,
                          JobMonitor& monitor)
{
    AnnotationTaker taker;
    ParsedText parsed{.text = text, .monitor = monitor};
    const Json json = Json::parse(ParsedLetter(parsed, 0), ParsedLetter(parsed, text.size()),
                                  std::ref(taker), false);
    if (parsed.is_canceled) {
        return Error{ErrorCode::Canceled, name + ": opening was canceled"};
    }
    const auto damaged = [&name](const std::string& why) {
        return Error{
            ErrorCode::Damaged,
            fmt::format("{}: damaged project: {}; open a copy of it or the maps themselves", name,
                        why)};
    };
    if (json.is_discarded()) {
        return text.find(kFormat) != std::string_view::npos
                   ? damaged("it is incomplete or not JSON")
                   : Error{ErrorCode::Invalid, name + ": not a MarsView project"};
    }
    if (!json.is_object() || !json.contains("format") || json["format"] != kFormat) {
        return Error{ErrorCode::Invalid, name + ": not a MarsView project"};
    }
    if (!json.contains("version") || !json["version"].is_number_unsigned() ||
        json["version"].get<std::uint64_t>() < 1) {
        return damaged("version is not a whole number from 1 up");
    }
    if (const auto version = json["version"].get<std::uint64_t>(); version > kProjectVersion) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("{}: saved by a newer version of MarsView: the project has format "
                                 "version {}, this program reads up to {}; update MarsView",
                                 name, version, kProjectVersion)};
    }
    std::string fault;
    Project project;
    Members members(json, "", fault);
    if (json.contains("layers")) {
        const Json& layers = json["layers"];
        if (!layers.is_array() || layers.size() > kLayersMax) {
            return damaged("layers is not a list of layers");
        }
        for (std::size_t i = 0; i < layers.size(); ++i) {
            Members layer(layers[i], fmt::format("layers[{}]", i), fault);
            project.layers.push_back(layerFrom(layer, folders));
        }
    } else {
        return damaged("the list of layers is missing");
    }
    members.index("active", project.active, project.layers.size());
    members.list("overlays", kLayersMax, "a list of vector files",
                 [&](const Json& element, const std::string& place) {
                     Members overlay(element, place, fault);
                     project.overlays.push_back(overlayFrom(overlay, folders));
                 });
    members.list("views", kViewsMax, "a list of views",
                 [&](const Json& element, const std::string& place) {
                     Members view(element, place, fault);
                     project.views.push_back(viewFrom(view, project.layers.size()));
                 });
    members.list("measurements", kDrawnMax, "a list of measurements",
                 [&](const Json& element, const std::string& place) {
                     Members measurement(element, place, fault);
                     project.measurements.push_back(
                         measurementFrom(measurement, project.layers.size()));
                 });
    members.list("annotations", kDrawnMax, "a list of annotations",
                 [&](const Json& element, const std::string& place) {
                     const Members annotation(element, place, fault); // not an object
                 });
    project.annotations = taker.take(project.layers.size(), fault);
    members.object("look", [&](Members& look) { project.look = lookFrom(look); });
    members.choice("layer_order", kOrders, project.order);
    members.object("camera", [&](Members& camera) { project.camera = cameraFrom(camera); });
    members.choice("scene", kScenes, project.scene);
    members.object("globe_camera",
                   [&](Members& camera) { project.globe_camera = viewCameraFrom(camera); });
    if (!fault.empty()) {
        return damaged(fault);
    }
    for (const auto& [key, value] : json.items()) {
        if (std::find(kKnownMembers.begin(), kKnownMembers.end(), key) == kKnownMembers.end()) {
            project.others[key] = value.dump();
        }
    }
    return project;
}

} // namespace

Result<Project>
projectFrom(std::string_view text, const ProjectFolders& folders, const std::string& name)
{
    JobMonitor monitor;
    return projectIn(text, folders, name, monitor);
}

Result<Project> readProject(const fs::path& path, const fs::path& bundled, JobMonitor& monitor)
{
    const std::string name = path.string();
    std::error_code problem;
    if (!fs::exists(path, problem)) {
        return Error{ErrorCode::NotFound, name + ": no such file"};
    }
    if (fs::is_directory(path, problem)) {
        return Error{ErrorCode::Invalid, name + ": a folder, not a MarsView project"};
    }
    if (const auto bytes = fs::file_size(path, problem); !problem && bytes > kBytesMax) {
        return Error{ErrorCode::TooLarge, name + ": larger than 1 GB, so not a MarsView project"};
    }
    std::ifstream file(path, std::ios::binary);
    std::string text(static_cast<std::size_t>(fs::file_size(path, problem)), '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (problem || !file) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: cannot be read: {}", name, std::strerror(errno))};
    }
    return projectIn(
        text, {.project = fs::absolute(path).lexically_normal().parent_path(), .bundled = bundled},
        name, monitor);
}

Status writeProject(const Project& project,
                    const fs::path& path,
                    const fs::path& bundled,
                    JobMonitor& monitor)
{
    const auto text =
        textOf(project,
               {.project = fs::absolute(path).lexically_normal().parent_path(), .bundled = bundled},
               monitor);
    if (monitor.isCanceled()) {
        return Error{ErrorCode::Canceled, path.string() + ": saving was canceled"};
    }
    if (!text) {
        return Error{text.error().code,
                     path.string() + ": cannot be saved: " + text.error().message};
    }
    return replaceFile(path, *text);
}

bool isProjectPath(const std::string& path)
{
    return lowerCase(fs::path(path).extension().string()) == ".mvproj";
}

} // namespace marsview
