// The stylus that the mouse moves: its mode, its goal, and its proxy on the surface.
#pragma once

#include "core/contact/contact_model.h"
#include "core/session/scene_surface.h"
#include "haptics/interaction/mouse_stylus.h"
#include "haptics/terrain/touch_map.h"

#include <memory>
#include <optional>

namespace marsview {

/// In contact while it presses, free while it hovers; a grab keeps that state. The proxy is never
/// below the surface. For the GUI thread: an update takes microseconds.
///
/// The sphere of a VirtualProxy is as wide as a cell of the touched map.
class Stylus {
public:
    /// Sets the surface. If only the exaggeration changes, the stylus keeps its position on the map
    /// and moves with it; otherwise it is lifted.
    void setGround(const SceneSurface& ground, double exaggeration);

    /// Sets the contact model. In contact, the proxy continues from its position.
    void setModel(ContactModelKind kind);
    ContactModelKind model() const noexcept { return kind_; }

    /// The pointer is over this point of the surface, where a screen point has the positive
    /// length `point_m`. While the map is grabbed, goal and proxy do not move.
    void aim(const GroundPoint& at, const StylusButtons& buttons, double point_m);
    /// Applies surface data loaded since the last call. Returns true if the proxy may have moved.
    /// Call it about thirty times a second while isWaiting().
    bool refresh();
    /// For a hand that has not moved since it began to press: presses again from straight above, to
    /// remove effects of the coarser surface that it may have met at first. No effect unless
    /// pressing.
    void pressAnew();
    /// Whether the surface below the stylus may still change by itself.
    bool isWaiting() const noexcept { return model_ != nullptr && touch_->isTiled(); }
    /// The pointer is not over a surface, or has left the view.
    void lift();
    /// Changes the pressing depth, within bounds, from the next aim on: deeper if factor > 1.
    void deepen(double factor);

    /// Empty while lifted.
    const std::optional<StylusPose>& pose() const noexcept { return pose_; }

private:
    std::shared_ptr<ServoMap> makeModel();
    void releaseModel();
    ScenePoint aimedGround() const;
    void press(const ScenePoint& goal);
    void keepOnItsMap(const ScenePoint& goal);
    void holdAbove(const ScenePoint& ground);
    bool isOnItsMap(const ScenePoint& proxy) const;
    void updatePose(StylusMode mode, const ScenePoint& goal);

    SceneSurface ground_;
    double exaggeration_ = 1.0;
    StylusReach reach_;
    GroundPoint at_; // the last argument of aim()
    double point_m_ = 1.0;
    ContactModelKind kind_ = kContactModelDefault;
    std::unique_ptr<TouchMap> touch_; // for the map aimed at, from the first touch on
    std::shared_ptr<ServoMap> model_; // on touch_; while in contact
    std::optional<StylusPose> pose_;
};

} // namespace marsview
