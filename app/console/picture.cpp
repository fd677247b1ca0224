#include "app/console/picture.h"

#include <cmath>
#include <fmt/format.h>

namespace marsview {
namespace {

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
        const GridPoint grid = georeference.toGrid(*options.look_at);
        const double last_column = static_cast<double>(georeference.columns() - 1);
        const double last_row = static_cast<double>(georeference.rows() - 1);
        if (!(grid.column >= 0.0 && grid.column <= last_column && grid.row >= 0.0 &&
              grid.row <= last_row)) {
            return Error{ErrorCode::OutOfRange,
                         fmt::format("--look-at: {},{} is not on the map", options.look_at->x,
                                     options.look_at->y)};
        }
        const double height_m = scene.map->heightfield().heightWaiting(grid);
        camera.target = georeference.sceneFrame().toScene(
            grid, std::isnan(height_m) ? 0.0 : height_m * exaggeration);
    }
    camera.distance_m = options.distance_m.value_or(home_distance_m);
    return scene.bounded(camera, exaggeration, Scene::Ground::Waiting);
}

} // namespace

Result<OffscreenPicture> drawPicture(const Scene& scene, const PictureOptions& options)
{
    const double exaggeration = options.exaggeration.value_or(scene.exaggeration);
    const Result<OrbitCamera> camera = cameraFrom(options, scene, exaggeration);
    if (!camera) {
        return camera.error();
    }
    DrawStyle style;
    style.exaggeration = exaggeration;
    style.look.mode = options.shading;
    style.look.has_contours = options.has_contours;
    style.look.light_azimuth = Angle::degrees(options.light_deg.front());
    style.look.light_altitude = Angle::degrees(options.light_deg.back());
    Result<OffscreenPicture> picture = drawOffscreen(
        *scene.renderer,
        {.camera = *camera,
         .viewport = options.viewport,
         .detail = {.error_px = options.error_px, .has_every_sample = options.has_every_sample},
         .samples = options.samples},
        style, DepthUse::No);
    if (picture && picture->report.problem) {
        return *picture->report.problem; // a part of the terrain would be coarser than requested
    }
    return picture;
}

} // namespace marsview
