// Pictures of a map as the window draws them, and as many of them as it takes.
#pragma once

#include "app/bench/reference/flight.h"
#include "app/console/scene.h"
#include "core/base/job_monitor.h"
#include "ui/render/frame_buffer.h"
#include "ui/render/governed_picture.h"

#include <condition_variable>
#include <memory>
#include <mutex>

namespace marsview {

/// A renderer that waits for news of what it lacked.
class TerrainStage {
public:
    static Result<std::unique_ptr<TerrainStage>> create(const Viewport& viewport);

    /// From now on this map is drawn.
    void show(std::shared_ptr<const Map> map);
    const Scene& scene() const noexcept { return scene_; }
    /// On a flight over the map, within the bounds of navigation.
    OrbitCamera camera(Flight flight, double t) const;
    /// Straight above a place, as wide as the given distance.
    OrbitCamera above(GridPoint place, double distance_m) const;

    DrawReport paint(const OrbitCamera& camera, PictureStage stage);
    /// Draws until everything of the camera's picture is there.
    DrawReport paintWhole(const OrbitCamera& camera, JobMonitor& monitor);

private:
    // Told on the renderer's threads, which may outlive the stage.
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
