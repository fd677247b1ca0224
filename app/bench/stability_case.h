// A simulated hand against what is hard to render: does it come to rest?
#pragma once

#include "core/contact/contact_model.h"
#include "haptics/drivers/simulated_hand.h"
#include "haptics/loop/haptic_tick.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace marsview {

/// What the hand presses on, or what happens meanwhile.
enum class StabilityScene : std::uint8_t {
    Plane,
    Ridge,        // a roof of 45°, beside its edge
    Canyon,       // a valley of 45°, in its bottom
    Checkerboard, // every other sample 2 mm high at the hand, stroked and then pressed
    WallCorner,   // wedged between a steep slope and two walls
    ModeSwitches, // grabbed and let go four times a second, then pressed
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
    double jitter_s = 2e-4; // ticks come so much too early or too late, evenly
    ForceMixing mixing = ForceMixing::Fade;
    bool is_passivity_kept = true;
    std::uint64_t seed = 1;
};

/// What the hand does in the last half second, when nothing happens any more.
struct StabilityResult {
    double ripple_m = 0.0;      // the widest of its ways along an axis, a steady drift taken out
    double speed_m_per_s = 0.0; // root mean square, likewise
    double energy_j_max = 0.0;  // of the whole run
    double contact_share = 0.0; // of ticks in which it touched the ground
    bool isStable() const noexcept
    {
        // Encoder steps of 20 um make ripples of some of them.
        return ripple_m <= 1.5e-4 && speed_m_per_s <= 0.01 && energy_j_max <= 0.1;
    }
};

/// Six seconds at 1 kHz. A pure function.
StabilityResult runStability(StabilityScene scene, const StabilityOptions& options);

/// The hand and the device of all scenes: `delay_s` is the run's.
HandOptions stabilityHand(double delay_s);

/// What the device of these runs states as its stable stiffness.
inline constexpr double kStatedStiffnessNPerM = 900.0;

/// The largest stiffness, in steps of a tenth from 50 N/m to `most`, below which every step is
/// stable. 0 where none is.
double largestStable(StabilityScene scene, StabilityOptions options, double most);

} // namespace marsview
