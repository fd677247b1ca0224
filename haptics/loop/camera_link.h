// Keeps a camera and the frame of a servo loop together, whichever of them moves.
#pragma once

#include "haptics/interaction/body_view.h"
#include "haptics/interaction/hand_view.h"
#include "haptics/loop/haptic_tick.h"

#include <cstdint>
#include <optional>

namespace marsview {

/// Where a loop is that has been given a frame.
struct LoopFrame {
    WorkspaceFrame seen; // that the camera follows
    std::uint64_t number = 0;
    StylusMode mode = StylusMode::Hover;
};

/// What a look at the loop has changed.
struct LinkStep {
    bool has_moved_camera = false;
    bool has_changed_settings = false; // to be passed to the loop
};

/// In the plane a View is a HandView within NavigationLimits, on a body a BodyHandView within
/// BodyLimits. For the thread that owns camera and settings.
template <typename View, typename Limits>
class CameraLink {
public:
    using Camera = decltype(View::camera);

    const View& view() const noexcept { return view_; }

    /// Camera and workspace are there from now on; the workspace fits what the camera shows.
    void begin(const View& view, const Limits& limits, LoopSettings& settings)
    {
        view_ = view;
        is_fitted_ = true;
        settings.fit.reset();
        pass(FrameOrigin::View, limits, settings);
    }

    /// Something else than the hand has moved the camera, or the picture has another size. True if
    /// the camera shows the same place from the same distance and side: the surface stays where the
    /// hand feels it, until follow() can fit the workspace in free space. Otherwise begin() again.
    bool keeps(const Camera& camera)
    {
        const auto seen = limitedView(view_, camera);
        if (!seen.is_moved) {
            view_ = seen.view;
            is_fitted_ = false;
        }
        return !seen.is_moved;
    }

    /// To be called about sixty times a second. Where the hand has moved the map, `show` gets the
    /// camera that follows it and returns it within its limits; beyond them the map returns to the
    /// camera. Once the map rests and the hand does not hold it, `fitted` returns the frame in
    /// which the workspace covers what the camera shows.
    template <typename Show, typename Fitted>
    LinkStep follow(const LoopFrame& loop,
                    const Limits& limits,
                    LoopSettings& settings,
                    const Show& show,
                    const Fitted& fitted)
    {
        if (loop.number != settings.frame_number) {
            return {};
        }
        if (loop.seen == view_.frame) {
            if (is_fitted_ || isHolding(loop.mode)) {
                return {};
            }
            is_fitted_ = true;
            settings.fit = WorkspaceFit{.seen = view_.frame, .fitted = fitted()};
            return {.has_changed_settings = true};
        }
        is_fitted_ = false;
        View followed = view_;
        followed.camera = cameraFollowing(view_, loop.seen);
        followed.frame = loop.seen;
        const auto limited = limitedView(followed, show(followed.camera));
        view_ = limited.view;
        if (limited.is_moved) {
            pass(FrameOrigin::Limit, limits, settings);
        }
        return {.has_moved_camera = true, .has_changed_settings = limited.is_moved};
    }

private:
    void pass(FrameOrigin origin, const Limits& limits, LoopSettings& settings) const
    {
        settings.frame = view_.frame;
        settings.frame_origin = origin;
        ++settings.frame_number;
        settings.view_bounds = boundsFor(view_, limits);
        boundZoom(view_, limits, settings.modes);
    }

    View view_;
    bool is_fitted_ = false; // the loop's fit is that of view_
};

using FlatCameraLink = CameraLink<HandView, NavigationLimits>;
using BodyCameraLink = CameraLink<BodyHandView, BodyLimits>;

} // namespace marsview
