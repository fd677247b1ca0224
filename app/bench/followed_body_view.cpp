#include "app/bench/followed_body_view.h"

#include <utility>

namespace marsview {

FollowedBodyView::FollowedBodyView(const WorkspaceBox& reach,
                                   const BodyLimits& limits,
                                   BodyGround ground)
    : reach_(reach)
    , limits_(limits)
    , ground_(std::move(ground))
{}

BodyCamera FollowedBodyView::limited(const BodyCamera& camera) const
{
    return constrained(camera, limits_, ground_);
}

WorkspaceFrame FollowedBodyView::fittedFrame() const
{
    constexpr Viewport kPicture{.width = 800, .height = 600};
    return frameForBodyView(view_.camera, kPicture, ground_, limits_.ellipsoid, reach_);
}

void FollowedBodyView::beginAt(const WorkspaceFrame& frame, LoopSettings& settings)
{
    const WorkspacePoint middle = reach_.low + (reach_.high - reach_.low) * 0.5;
    const BodyPlace place = placeOf(frame.toScene(middle), limits_.ellipsoid);
    const double width_m = (reach_.high.x - reach_.low.x) * frame.scene_per_meter;
    view_.camera = {.target = place.foot, .distance_m = width_m};
    // What the workspace covers grows about as the distance does.
    view_.camera.distance_m *= frame.scene_per_meter / fittedFrame().scene_per_meter;
    view_.camera = limited(view_.camera);
    view_.frame = frame;
    is_fitted_ = true;
    settings.fit.reset();
    takeView(FrameOrigin::View, settings);
}

void FollowedBodyView::takeView(FrameOrigin origin, LoopSettings& settings) const
{
    settings.frame = view_.frame;
    settings.frame_origin = origin;
    ++settings.frame_number;
    boundZoom(view_, limits_, settings.modes);
}

bool FollowedBodyView::follow(const WorkspaceFrame& seen_frame,
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
    const BodyCamera followed = cameraFollowing(view_, seen_frame, limits_.ellipsoid);
    const LimitedBodyView limited_view = limitedView({.camera = followed, .frame = seen_frame},
                                                     limited(followed), limits_.ellipsoid);
    view_ = limited_view.view;
    if (limited_view.is_moved) {
        takeView(FrameOrigin::Limit, settings);
    }
    return limited_view.is_moved;
}

} // namespace marsview
