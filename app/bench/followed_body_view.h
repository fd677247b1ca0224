// A camera over a body that follows a hand in a servo loop, within the camera's limits, without a
// window.
#pragma once

#include "core/globe/body_navigation.h"
#include "haptics/loop/camera_link.h"

#include <cstdint>

namespace marsview {

/// As FollowedView for a map in the plane: about 60 times a second the camera follows the frame
/// that the hand has moved; where a limit of the camera corrects it, the loop gets the corrected
/// frame; and after the hand has moved the body, the workspace is fitted to the view.
class FollowedBodyView {
public:
    /// `ground` is called by the thread that owns the view.
    FollowedBodyView(const WorkspaceBox& reach, const BodyLimits& limits, BodyGround ground);

    /// The workspace is at `frame`, and the camera shows as much as it covers there.
    void beginAt(const WorkspaceFrame& frame, LoopSettings& settings);
    /// Follows a loop whose frame is `seen_frame`, begun from the frame numbered `frame_number`.
    /// True if `settings` have changed.
    bool follow(const WorkspaceFrame& seen_frame,
                std::uint64_t frame_number,
                StylusMode mode,
                LoopSettings& settings);

    const BodyCamera& camera() const noexcept { return link_.view().camera; }
    /// The frame that fits what the camera shows.
    WorkspaceFrame fittedFrame() const { return frameFor(camera()); }

private:
    BodyCamera limited(const BodyCamera& camera) const;
    WorkspaceFrame frameFor(const BodyCamera& camera) const;

    WorkspaceBox reach_;
    BodyLimits limits_;
    BodyGround ground_;
    BodyCameraLink link_;
};

} // namespace marsview
