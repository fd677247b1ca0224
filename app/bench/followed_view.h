// A camera that follows a hand in a servo loop, within the camera's limits, without a window.
#pragma once

#include "core/geo/scene_frame.h"
#include "core/view/navigation.h"
#include "haptics/device/workspace.h"
#include "haptics/loop/camera_link.h"

#include <cstddef>
#include <cstdint>

namespace marsview {

/// The map that a camera shows.
struct FollowedMap {
    SceneFrame frame;
    std::size_t columns = 0;
    std::size_t rows = 0;
    NavigationLimits limits;
    GroundQuery height_m;
};

/// As the window does it (HapticsController), about 60 times a second: the camera follows the frame
/// that the hand has moved; where a limit of the camera corrects it, the loop gets the corrected
/// frame; and after the hand has moved the map, the workspace is fitted to the view.
class FollowedView {
public:
    explicit FollowedView(WorkspaceBox reach);

    void setMap(FollowedMap map) { map_ = std::move(map); }
    /// Moves the camera; the workspace fits the new view at once.
    void moveCamera(const OrbitCamera& camera, LoopSettings& settings);
    /// The workspace is at `frame`, and the camera shows as much as it covers there.
    void beginAt(const WorkspaceFrame& frame, LoopSettings& settings);
    /// Follows a loop whose frame is `seen_frame`, begun from the frame numbered `frame_number`.
    /// True if `settings` have changed.
    bool follow(const WorkspaceFrame& seen_frame,
                std::uint64_t frame_number,
                StylusMode mode,
                LoopSettings& settings);

    const OrbitCamera& camera() const noexcept { return link_.view().camera; }
    /// The camera within its limits.
    OrbitCamera limited(const OrbitCamera& camera) const;
    /// The frame that fits what the camera shows.
    WorkspaceFrame fittedFrame() const { return frameFor(camera()); }

private:
    WorkspaceFrame frameFor(const OrbitCamera& camera) const;

    WorkspaceBox reach_;
    FollowedMap map_;
    FlatCameraLink link_;
};

} // namespace marsview
