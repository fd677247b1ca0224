#include "app/bench/followed_view.h"

#include <utility>

namespace marsview {
namespace {

constexpr Viewport kViewport{.width = 800, .height = 600};

} // namespace

FollowedView::FollowedView(WorkspaceBox reach)
    : reach_(reach)
{}

OrbitCamera FollowedView::limited(const OrbitCamera& camera) const
{
    return constrained(camera, map_.limits, map_.height_m);
}

WorkspaceFrame FollowedView::frameFor(const OrbitCamera& camera) const
{
    return frameForView(camera, kViewport,
                        {.frame = map_.frame, .columns = map_.columns, .rows = map_.rows},
                        map_.limits.box, reach_);
}

void FollowedView::moveCamera(const OrbitCamera& camera, LoopSettings& settings)
{
    const OrbitCamera moved = limited(camera);
    link_.begin({.camera = moved, .frame = frameFor(moved)}, map_.limits, settings);
}

void FollowedView::beginAt(const WorkspaceFrame& frame, LoopSettings& settings)
{
    OrbitCamera camera{.target = frame.place, .distance_m = map_.limits.box.diagonal_m()};
    // What the workspace covers grows about as the distance does.
    camera.distance_m *= frame.scene_per_meter / frameFor(camera).scene_per_meter;
    link_.begin({.camera = limited(camera), .frame = frame}, map_.limits, settings);
}

bool FollowedView::follow(const WorkspaceFrame& seen_frame,
                          std::uint64_t frame_number,
                          StylusMode mode,
                          LoopSettings& settings)
{
    return link_
        .follow(
            {.seen = seen_frame, .number = frame_number, .mode = mode}, map_.limits, settings,
            [this](const OrbitCamera& camera) { return limited(camera); },
            [this] { return fittedFrame(); })
        .has_changed_settings;
}

} // namespace marsview
