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

WorkspaceFrame FollowedView::fittedFrame() const
{
    return frameForView(view_.camera, kViewport,
                        {.frame = map_.frame, .columns = map_.columns, .rows = map_.rows},
                        map_.limits.box, reach_);
}

void FollowedView::moveCamera(const OrbitCamera& camera, LoopSettings& settings)
{
    view_.camera = limited(camera);
    view_.frame = fittedFrame();
    is_fitted_ = true;
    settings.fit.reset();
    takeView(FrameOrigin::View, settings);
}

void FollowedView::beginAt(const WorkspaceFrame& frame, LoopSettings& settings)
{
    view_.camera = {.target = frame.place, .distance_m = map_.limits.box.diagonal_m()};
    // What the workspace covers grows about as the distance does.
    view_.camera.distance_m *= frame.scene_per_meter / fittedFrame().scene_per_meter;
    view_.camera = limited(view_.camera);
    view_.frame = frame;
    is_fitted_ = true;
    settings.fit.reset();
    takeView(FrameOrigin::View, settings);
}

void FollowedView::takeView(FrameOrigin origin, LoopSettings& settings) const
{
    settings.frame = view_.frame;
    settings.frame_origin = origin;
    ++settings.frame_number;
    settings.view_bounds = boundsFor(view_, map_.limits);
    boundZoom(view_, map_.limits, settings.modes);
}

bool FollowedView::follow(const WorkspaceFrame& seen_frame,
                          std::uint64_t frame_number,
                          StylusMode mode,
                          LoopSettings& settings)
{
    if (frame_number != settings.frame_number) {
        return false;
    }
    if (seen_frame == view_.frame) {
        if (is_fitted_ || isHolding(mode)) {
            return false;
        }
        is_fitted_ = true;
        settings.fit = WorkspaceFit{.seen = view_.frame, .fitted = fittedFrame()};
        return true;
    }
    is_fitted_ = false;
    const OrbitCamera followed = cameraFollowing(view_, seen_frame);
    const LimitedView limited_view =
        limitedView({.camera = followed, .frame = seen_frame}, limited(followed));
    view_ = limited_view.view;
    if (limited_view.is_moved) {
        takeView(FrameOrigin::Limit, settings);
    }
    return limited_view.is_moved;
}

} // namespace marsview
