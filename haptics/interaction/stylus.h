// The stylus that the mouse moves: its mode, its goal, and the proxy that the ground holds.
#pragma once

#include "core/contact/contact_model.h"
#include "core/session/scene_surface.h"
#include "haptics/interaction/mouse_stylus.h"
#include "haptics/terrain/map_touch.h"

#include <memory>
#include <optional>

namespace marsview {

/// Where the stylus is and what the ground does to it. In scene coordinates.
struct StylusPose {
    StylusMode mode = StylusMode::Hover;
    ScenePoint proxy;
    ScenePoint goal;
    bool is_in_contact = false;
    Vec3 force_n{};                  // on the hand
    double force_n_max = kForceNMax; // that it can be

    bool operator==(const StylusPose&) const = default;
};

/// In contact while it presses, free while it hovers; a grab keeps it as it was. The proxy is never
/// below the ground. For the GUI thread: an update takes microseconds.
///
/// A virtual proxy's sphere is as wide as a cell of the map that it touches.
class Stylus {
public:
    /// The ground it moves over from now on. Where only the exaggeration changes, the stylus stays
    /// over or on the same piece of ground and moves with it; otherwise it is lifted.
    void setGround(const SceneSurface& ground, double exaggeration);

    /// What moves the proxy from now on. In contact, the proxy goes on from where it is.
    void setModel(ContactModelKind kind);
    ContactModelKind model() const noexcept { return kind_; }

    /// The pointer is over this point of the ground, where a point of the screen is `point_m` > 0
    /// long. While grabbed, goal and proxy stay where they are.
    void aim(const GroundPoint& at, const StylusButtons& buttons, double point_m);
    /// Takes in what has been loaded of the ground since the last call. True where the proxy may
    /// have moved with it. For ground that comes in tiles, some thirty times a second while
    /// isWaiting().
    bool refresh();
    /// For a hand that has not moved since it began to press: it presses once more, from straight
    /// above, so that nothing is left of the coarser ground that it may have met at first. Nothing
    /// where it does not press.
    void pressAnew();
    /// Whether the ground below the stylus may still change by itself.
    bool isWaiting() const noexcept { return model_ != nullptr && touch_->isTiled(); }
    /// The pointer is over no ground, or has left.
    void lift();
    /// Presses deeper (factor > 1) or less deep from the next aim on, within bounds.
    void deepen(double factor);

    /// Nothing while lifted.
    const std::optional<StylusPose>& pose() const noexcept { return pose_; }

private:
    std::unique_ptr<MapContactModel> makeModel();
    void letGo();
    ScenePoint aimedGround() const;
    void press(const ScenePoint& goal);
    void keepOnItsMap(const ScenePoint& goal);
    void holdAbove(const ScenePoint& ground);
    bool isOnItsMap(const ScenePoint& proxy) const;
    void updatePose(StylusMode mode, const ScenePoint& goal);

    SceneSurface ground_;
    double exaggeration_ = 1.0;
    StylusReach reach_;
    GroundPoint at_; // aimed at last
    double point_m_ = 1.0;
    ContactModelKind kind_ = kContactModelDefault;
    std::unique_ptr<MapTouch> touch_;        // of the map aimed at, once it was touched
    std::unique_ptr<MapContactModel> model_; // over it; while in contact
    std::optional<StylusPose> pose_;
};

} // namespace marsview
