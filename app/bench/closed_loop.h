// Hand, tick, frame, camera and the camera's limits in one loop, without window or clock.
#pragma once

#include "app/bench/followed_view.h"
#include "haptics/drivers/simulated/simulated_hand.h"
#include "haptics/loop/haptic_tick.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace marsview {

struct ClosedLoopOptions {
    DeviceCapabilities device; // the walls are those of its workspace
    HandOptions hand;
    WorkspacePoint hand_begin{};
    double stiffness_n_per_m = 400.0;
    std::uint64_t poll_ticks = 16; // between two looks of the view at the loop
};

/// A window's side and a loop's side of touching, with the code of both: at 1 kHz a simulated hand
/// moves and step() computes its force; 60 times a second the camera follows the hand within its
/// limits. The map lies level; one scene unit is one meter.
class ClosedLoop {
public:
    using HeightOf = std::function<double(double x, double y)>;

    /// `height_m` is the surface of `map`, in the scene, NaN outside it.
    ClosedLoop(ClosedLoopOptions options, std::shared_ptr<ServoMap> map, HeightOf height_m);

    LoopSettings settings; // the map, the button, walls; frames are set by the loop
    /// Another map, or none. `height_m` is its surface.
    void setMap(std::shared_ptr<ServoMap> map, HeightOf height_m);
    /// The user moves the camera; the workspace fits the new view at once.
    void moveCamera(const OrbitCamera& camera);

    SimulatedHand& hand() noexcept { return hand_; }
    const SimulatedHand& hand() const noexcept { return hand_; }
    /// Of the stylus, in radians, counterclockwise seen from above.
    void twist(double radians) noexcept { twist_rad_ = radians; }

    /// One millisecond, or `dt_s`.
    const StepResult& tick(double dt_s = 1e-3);
    const StepResult& last() const noexcept { return last_; }
    std::uint64_t ticks() const noexcept { return ticks_; }
    const TickState& state() const noexcept { return state_; }
    const TickOptions& options() const noexcept { return tick_options_; }
    const WorkspaceFrame& frame() const noexcept { return state_.frame; }
    const OrbitCamera& camera() const noexcept { return view_.camera(); }
    /// The camera within its limits.
    OrbitCamera limited(const OrbitCamera& camera) const { return view_.limited(camera); }
    /// The frame that fits what the camera shows.
    WorkspaceFrame fittedFrame() const { return view_.fittedFrame(); }
    /// Of the surface straight below the hand, in the workspace; NaN outside the map.
    double surfaceZ() const;

private:
    ClosedLoopOptions options_;
    TickOptions tick_options_;
    TickState state_;
    TickInput input_;
    StepResult last_;
    SimulatedHand hand_;
    double twist_rad_ = 0.0;
    HeightOf height_m_;
    FollowedView view_;
    std::uint64_t ticks_ = 0;
};

} // namespace marsview
