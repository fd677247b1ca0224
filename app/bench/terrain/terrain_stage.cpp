#include "app/bench/terrain/terrain_stage.h"

#include "core/view/color_ramp.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <utility>

namespace marsview {

Result<std::unique_ptr<TerrainStage>> TerrainStage::create(const Viewport& viewport)
{
    auto news = std::make_shared<News>();
    Result<Scene> scene = emptyScene([news] {
        {
            const std::lock_guard lock(news->mutex);
            news->is_there = true;
        }
        news->has_come.notify_all();
    });
    if (!scene) {
        return std::move(scene).error();
    }
    std::unique_ptr<TerrainStage> stage(
        new TerrainStage(std::move(scene).value(), viewport, std::move(news)));
    if (!stage->buffer_.isComplete()) {
        return Error{ErrorCode::OutOfRange,
                     fmt::format("{} × {} pixels: this driver has no frame buffer of that size",
                                 viewport.width, viewport.height)};
    }
    return stage;
}

TerrainStage::TerrainStage(Scene scene, const Viewport& viewport, std::shared_ptr<News> news)
    : scene_(std::move(scene))
    , viewport_(viewport)
    , news_(std::move(news))
    , buffer_(viewport)
    , picture_(*scene_.renderer)
{}

void TerrainStage::show(std::shared_ptr<const Map> map)
{
    showIn(scene_, std::move(map), nullptr);
}

OrbitCamera TerrainStage::camera(Flight flight, double t) const
{
    const Georeference& georeference = scene_.map->georeference();
    const FlightGround ground{
        .box = scene_.box(scene_.exaggeration),
        .pixel_m = std::min(georeference.pixelWidthMeters(), georeference.pixelHeightMeters()),
        .height = [this](double east_m, double north_m) {
            return scene_.ground(east_m, north_m, scene_.exaggeration);
        }};
    return scene_.bounded(cameraOn(flight, t, ground, viewport_), scene_.exaggeration);
}

OrbitCamera TerrainStage::above(GridPoint place, double distance_m) const
{
    OrbitCamera camera = this->camera(Flight::Orbit, 0.0);
    camera.target = scene_.map->georeference().sceneFrame().toScene(place, 0.0);
    camera.distance_m = distance_m;
    return scene_.bounded(camera, scene_.exaggeration);
}

DrawReport TerrainStage::paint(const OrbitCamera& camera, PictureStage stage)
{
    DrawStyle style;
    style.exaggeration = scene_.exaggeration;
    return picture_.paint({.camera = camera, .viewport = viewport_, .stage = stage}, style,
                          buffer_.id());
}

DrawReport TerrainStage::paintWhole(const OrbitCamera& camera, JobMonitor& monitor)
{
    constexpr std::chrono::milliseconds kPatience{100};
    DrawReport report = paint(camera, PictureStage::Sharp);
    while (!report.is_complete && !monitor.isCanceled()) {
        {
            std::unique_lock lock(news_->mutex);
            news_->has_come.wait_for(lock, kPatience, [this] { return news_->is_there; });
            news_->is_there = false;
        }
        report = paint(camera, PictureStage::Sharp);
    }
    return report;
}

} // namespace marsview
