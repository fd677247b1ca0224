// Draws pictures of a map as the window does, repeatedly until they are complete.
#pragma once

#include "app/bench/reference/flight.h"
#include "app/console/scene.h"
#include "core/base/job_monitor.h"
#include "ui/render/governed_picture.h"
#include "ui/render/opengl/frame_buffer.h"

#include <condition_variable>
#include <memory>
#include <mutex>

namespace marsview {

/// A renderer, and a wait for newly loaded tiles.
class TerrainStage {
public:
    static Result<std::unique_ptr<TerrainStage>> create(const Viewport& viewport);

    /// From now on this map is drawn.
    void show(std::shared_ptr<const Map> map);
    const Scene& scene() const noexcept { return scene_; }
    /// A camera on a flight over the map, within the limits of navigation.
    OrbitCamera camera(Flight flight, double t) const;
    /// A camera straight above a place, at the given distance.
    OrbitCamera above(GridPoint place, double distance_m) const;

    DrawReport paint(const OrbitCamera& camera, PictureStage stage);
    /// Draws until the camera's picture is complete.
    DrawReport paintWhole(const OrbitCamera& camera, JobMonitor& monitor);

private:
    // Notified on the renderer's threads, which may outlive the stage.
    struct News {
        std::mutex mutex;
        std::condition_variable has_come;
        bool is_there = false;
    };

    TerrainStage(Scene scene, const Viewport& viewport, std::shared_ptr<News> news);

    Scene scene_;
    Viewport viewport_;
    std::shared_ptr<News> news_;
    FrameBuffer buffer_;
    GovernedPicture picture_;
};

} // namespace marsview
