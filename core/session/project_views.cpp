#include "core/session/project_views.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace marsview {

namespace {

constexpr const char* kOnGlobe = "globe";

} // namespace

void putCamera(Json& json, const ViewCamera& camera)
{
    if (const auto* point = std::get_if<GeographicPoint>(&camera.target)) {
        json["longitude_deg"] = degreesOf(point->longitude);
        json["latitude_deg"] = degreesOf(point->latitude);
    } else {
        const auto& target = std::get<MapPoint>(camera.target);
        json["x"] = target.x;
        json["y"] = target.y;
    }
    json["elevation_m"] = camera.elevation_m;
    json["distance_m"] = camera.distance_m;
    json["azimuth_deg"] = degreesOf(camera.azimuth);
    json["tilt_deg"] = degreesOf(camera.tilt);
    json["field_of_view_deg"] = degreesOf(camera.field_of_view);
}

Json viewJson(const ProjectView& view)
{
    Json json = Json::object();
    json["name"] = view.name;
    if (view.layer) {
        json["layer"] = *view.layer;
    }
    if (!view.body.empty()) {
        json["body"] = view.body;
    }
    if (view.is_on_globe) {
        json["scene"] = kOnGlobe;
    }
    putCamera(json, view.camera);
    json["exaggeration"] = view.exaggeration;
    return json;
}

ViewCamera viewCameraFrom(Members& members)
{
    ViewCamera camera;
    if (members.has("x") || members.has("y")) {
        MapPoint target;
        members.number("x", target.x);
        members.number("y", target.y);
        camera.target = target;
    } else {
        GeographicPoint target;
        members.angle(
            "longitude_deg", target.longitude, [](double) { return true; }, "an angle");
        members.angle(
            "latitude_deg", target.latitude,
            [](double degrees) { return std::abs(degrees) <= 90.0; }, "an angle from -90 to 90");
        camera.target = target;
    }
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

ProjectView viewFrom(Members& members, std::size_t layer_count)
{
    ProjectView view;
    members.text("name", view.name);
    members.index("layer", view.layer, layer_count);
    members.text("body", view.body);
    std::string scene;
    members.text("scene", scene);
    view.is_on_globe = scene == kOnGlobe;
    view.camera = viewCameraFrom(members);
    members.number(
        "exaggeration", view.exaggeration, [](double factor) { return factor > 0.0; },
        "a factor above 0");
    return view;
}

std::vector<ProjectView> projectViews(const std::vector<SavedView>& views,
                                      const std::vector<LayerId>& layers)
{
    std::vector<ProjectView> result;
    for (const SavedView& view : views) {
        ProjectView saved{.name = view.name,
                          .camera = view.camera,
                          .exaggeration = view.exaggeration,
                          .body = view.body,
                          .is_on_globe = view.is_on_globe};
        if (const auto layer = std::find(layers.begin(), layers.end(), view.layer);
            layer != layers.end()) {
            saved.layer = static_cast<std::size_t>(layer - layers.begin());
        }
        result.push_back(std::move(saved));
    }
    return result;
}

std::vector<SavedView> savedViews(const std::vector<ProjectView>& views,
                                  const std::vector<LayerId>& layers,
                                  std::uint32_t first_id)
{
    std::vector<SavedView> result;
    for (const ProjectView& view : views) {
        result.push_back({.id = ViewId{first_id++},
                          .name = view.name,
                          .camera = view.camera,
                          .exaggeration = view.exaggeration,
                          .layer = view.layer ? layers.at(*view.layer) : LayerId::None,
                          .body = view.body,
                          .is_on_globe = view.is_on_globe});
    }
    return result;
}

} // namespace marsview
