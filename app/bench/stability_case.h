// A simulated hand in situations that are hard to render: does it come to rest?
#pragma once

#include "core/contact/contact_model.h"
#include "haptics/drivers/simulated/simulated_hand.h"
#include "haptics/loop/haptic_tick.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace marsview {

/// The surface under the hand, or the events during the run.
enum class StabilityScene : std::uint8_t {
    Plane,
    Ridge,        // a 45° roof, next to its edge
    Canyon,       // a 45° valley, at its bottom
    Checkerboard, // every other sample 2 mm high in the workspace, stroked and then pressed
    WallCorner,   // wedged between a steep slope and two walls
    ModeSwitches, // grabbed and released four times a second, then pressed
    PanHold,      // grabbed in contact, and held
    ZoomHold,     // grabbed in free space, and held
    MapChange,    // another map and another place three times a second, then pressed
};

inline constexpr std::array kStabilityScenes{
    StabilityScene::Plane,        StabilityScene::Ridge,      StabilityScene::Canyon,
    StabilityScene::Checkerboard, StabilityScene::WallCorner, StabilityScene::ModeSwitches,
    StabilityScene::PanHold,      StabilityScene::ZoomHold,   StabilityScene::MapChange,
};

std::string_view stabilitySceneName(StabilityScene scene) noexcept;

struct StabilityOptions {
    ContactModelKind model = kContactModelDefault;
    double stiffness_n_per_m = 500.0;
    double delay_s = 0.0;
    double jitter_s = 2e-4; // ticks are early or late by up to this, uniformly distributed
    ForceMixing mixing = ForceMixing::Fade;
    bool is_passivity_kept = true;
    std::uint64_t seed = 1;
};

/// The hand's motion in the last half second, when it should be at rest.
struct StabilityResult {
    double ripple_m = 0.0;      // the largest range along an axis, without a linear drift
    double speed_m_per_s = 0.0; // root mean square, without the drift
    double energy_j_max = 0.0;  // of the whole run
    double contact_share = 0.0; // fraction of ticks in contact
    bool isStable() const noexcept
    {
        // Encoder steps of 20 um cause ripples of a few steps.
        return ripple_m <= 1.5e-4 && speed_m_per_s <= 0.01 && energy_j_max <= 0.1;
    }
};

/// Six seconds at 1 kHz. A pure function.
StabilityResult runStability(StabilityScene scene, const StabilityOptions& options);

/// The hand and the device of all scenes, with this run's `delay_s`.
HandOptions stabilityHand(double delay_s);

/// The stable stiffness that the device of these runs states.
inline constexpr double kStatedStiffnessNPerM = 900.0;

/// The largest stiffness, in steps of a tenth from 50 N/m to `most`, up to which every step is
/// stable; 0 if none is.
double largestStable(StabilityScene scene, StabilityOptions options, double most);

} // namespace marsview
