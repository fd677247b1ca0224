// The stylus that the mouse moves: its mode, its goal, and the proxy that the ground holds.
#pragma once

#include "core/contact/heightfield_surface.h"
#include "core/contact/proxy_graph.h"
#include "core/session/scene_surface.h"
#include "haptics/interaction/mouse_stylus.h"

#include <optional>

namespace marsview {

/// Where the stylus is and what the ground does to it. In scene coordinates.
struct StylusPose {
    StylusMode mode = StylusMode::Hover;
    ScenePoint proxy;
    ScenePoint goal;
    bool is_in_contact = false;
    Vec3 force_n{}; // on the hand
};

/// For the GUI thread: an update takes microseconds.
class Stylus {
public:
    /// The ground it moves over from now on. A proxy in contact stays on the same piece of ground
    /// where only the exaggeration changes.
    void setGround(const SceneSurface& ground, double exaggeration);

    /// The pointer is over this point of the ground, where a point of the screen is `point_m` long.
    /// While grabbed, goal and proxy stay where they are.
    void aim(const GroundPoint& at, const StylusButtons& buttons, double point_m);
    /// The pointer is over no ground, or has left.
    void lift();
    /// Presses deeper (factor > 1) or less deep, within bounds.
    void deepen(double factor);

    /// Nothing while lifted.
    const std::optional<StylusPose>& pose() const noexcept { return pose_; }

private:
    using Model = ProxyGraph<HeightfieldSurface>;

    HeightfieldSurface surfaceOf(std::size_t index) const;

    SceneSurface ground_;
    double exaggeration_ = 1.0;
    StylusReach reach_;
    std::size_t index_ = 0;      // of the map that model_ is about
    std::optional<Model> model_; // nothing until something is aimed at
    std::optional<StylusPose> pose_;
};

} // namespace marsview
