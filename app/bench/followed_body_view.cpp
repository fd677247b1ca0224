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

WorkspaceFrame FollowedBodyView::frameFor(const BodyCamera& camera) const
{
    constexpr Viewport kPicture{.width = 800, .height = 600};
    return frameForBodyView(camera, kPicture, ground_, limits_.ellipsoid, reach_);
}

void FollowedBodyView::beginAt(const WorkspaceFrame& frame, LoopSettings& settings)
{
    const WorkspacePoint middle = reach_.low + (reach_.high - reach_.low) * 0.5;
    const BodyPlace place = placeOf(frame.toScene(middle), limits_.ellipsoid);
    const double width_m = (reach_.high.x - reach_.low.x) * frame.scene_per_meter;
    BodyCamera camera{.target = place.foot, .distance_m = width_m};
    // What the workspace covers grows about as the distance does.
    camera.distance_m *= frame.scene_per_meter / frameFor(camera).scene_per_meter;
    link_.begin({.camera = limited(camera), .frame = frame, .body = limits_.ellipsoid}, limits_,
                settings);
}

bool FollowedBodyView::follow(const WorkspaceFrame& seen_frame,
                              std::uint64_t frame_number,
                              StylusMode mode,
                              LoopSettings& settings)
{
    return link_
        .follow(
            {.seen = seen_frame, .number = frame_number, .mode = mode}, limits_, settings,
            [this](const BodyCamera& camera) { return limited(camera); },
            [this] { return fittedFrame(); })
        .has_changed_settings;
}

} // namespace marsview
