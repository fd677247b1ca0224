#include "app/console/picture.h"

#include "core/globe/body_navigation.h"
#include "core/session/body_terrain.h"
#include "ui/render/supersampled_picture.h"

#include <cmath>
#include <fmt/format.h>

namespace marsview {
namespace {

Result<GridPoint> placeOnMap(const Scene& scene, const MapPoint& look_at)
{
    const Georeference& georeference = scene.map->georeference();
    const GridPoint grid = georeference.toGrid(look_at);
    const double last_column = static_cast<double>(georeference.columns() - 1);
    const double last_row = static_cast<double>(georeference.rows() - 1);
    if (!(grid.column >= 0.0 && grid.column <= last_column && grid.row >= 0.0 &&
          grid.row <= last_row)) {
        return Error{ErrorCode::OutOfRange,
                     fmt::format("--look-at: {},{} is not on the map", look_at.x, look_at.y)};
    }
    return grid;
}

Result<OrbitCamera>
cameraFrom(const PictureOptions& options, const Scene& scene, double exaggeration)
{
    OrbitCamera camera = homeCamera(scene.box(exaggeration), options.viewport);
    const double home_distance_m = camera.distance_m;
    if (options.tilt_deg) {
        camera.tilt = Angle::degrees(*options.tilt_deg);
    }
    camera.azimuth = Angle::degrees(options.azimuth_deg);
    if (options.look_at) {
        const Georeference& georeference = scene.map->georeference();
        const Result<GridPoint> place = placeOnMap(scene, *options.look_at);
        if (!place) {
            return place.error();
        }
        const GridPoint grid = *place;
        const double height_m = scene.map->heightfield().heightWaiting(grid);
        camera.target = georeference.sceneFrame().toScene(
            grid, std::isnan(height_m) ? 0.0 : height_m * exaggeration);
    }
    if (options.look_at || options.distance_m) {
        camera.distance_m = options.distance_m.value_or(home_distance_m);
    } else {
        camera = homeCamera(scene.box(exaggeration), options.viewport,
                            ViewDirection{.azimuth = camera.azimuth, .tilt = camera.tilt});
    }
    return scene.bounded(camera, exaggeration, Scene::Ground::Waiting);
}

// Longitude is periodic where the map is, and a map that closes around a pole covers it.
Result<GeographicPoint> placeOnBody(const BodyTerrain& terrain, const MapPoint& look_at)
{
    const Georeference& georeference = terrain.map()->georeference();
    const auto place = georeference.toGeographic(georeference.toGrid(look_at));
    if (!place || !terrain.gridAt(*place)) {
        return Error{ErrorCode::OutOfRange,
                     fmt::format("--look-at: {},{} is not on the map", look_at.x, look_at.y)};
    }
    return *place;
}

// The camera in the scene of the body.
Result<CameraPose>
bodyPoseFrom(const PictureOptions& options, const Scene& scene, double exaggeration)
{
    const HeightRange range = scene.on_body.range();
    const BodyLimits limits = bodyLimits(*scene.body_grid, range.minimum_m * exaggeration,
                                         range.maximum_m * exaggeration);
    const BodyTerrain& terrain = scene.on_body.maps().front();
    const auto height = [&](const GeographicPoint& place) {
        double height_m = std::numeric_limits<double>::quiet_NaN();
        for (const BodyTerrain& map : scene.on_body.maps()) {
            if (std::isnan(height_m)) {
                height_m = exaggeration * map.height(place, BodyTerrain::Tiles::Waiting);
            }
        }
        return height_m;
    };
    BodyCamera camera = homeCamera(limits, options.viewport);
    if (options.tilt_deg) {
        camera.tilt = Angle::degrees(*options.tilt_deg);
    }
    camera.azimuth = Angle::degrees(options.azimuth_deg);
    camera.distance_m = options.distance_m.value_or(camera.distance_m);
    if (options.look_at) {
        const Result<GeographicPoint> place = placeOnBody(terrain, *options.look_at);
        if (!place) {
            return place.error();
        }
        camera.target = *place;
        const double height_m = height(*place);
        camera.height_m = std::isnan(height_m) ? 0.0 : height_m;
    }
    camera = constrained(camera, limits, height);
    return poseOf(camera, limits.ellipsoid);
}

} // namespace

Result<OffscreenPicture> drawPicture(const Scene& scene, const PictureOptions& options)
{
    const double exaggeration = options.exaggeration.value_or(scene.exaggeration);
    DrawRequest request{
        .viewport = options.viewport,
        .detail = {.error_px = options.error_px, .has_every_sample = options.has_every_sample},
        .samples = options.samples.value_or(kSmoothSamples)};
    if (scene.body_grid) {
        const Result<CameraPose> pose = bodyPoseFrom(options, scene, exaggeration);
        if (!pose) {
            return pose.error();
        }
        request.body_pose = *pose;
    } else {
        const Result<OrbitCamera> camera = cameraFrom(options, scene, exaggeration);
        if (!camera) {
            return camera.error();
        }
        request.camera = *camera;
    }
    DrawStyle style;
    style.exaggeration = exaggeration;
    style.look.mode = options.shading;
    style.look.has_contours = options.has_contours;
    style.look.light_azimuth = Angle::degrees(options.light_deg.front());
    style.look.light_altitude = Angle::degrees(options.light_deg.back());
    style.look.light_frame = options.subsolar ? LightFrame::Body : LightFrame::View;
    style.look.subsolar = options.subsolar;
    Result<OffscreenPicture> picture = drawOffscreen(*scene.renderer, request, style, DepthUse::No);
    // Every sample: colors of single points of pixels would be those of some of them.
    if (picture && !options.samples &&
        (options.has_every_sample || contrastOf(picture->colors, style) > kSmoothContrastMax)) {
        SupersampledPicture finer(*scene.renderer, request, style);
        if (const Status finished = finer.finish(); !finished) {
            return finished.error();
        }
        picture->colors = finer.colors();
        picture->report = finer.report();
    }
    if (picture && picture->report.problem) {
        return *picture->report.problem; // a part of the terrain would be coarser than requested
    }
    return picture;
}

} // namespace marsview
