// Random sessions of touching in a closed loop, judged by what must hold in each of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace marsview {

/// What must hold for any motion of a hand.
enum class TouchInvariant : std::uint8_t {
    ForceIsFiniteAndWithinLimits,
    ForceChangesNoFasterThanTheLimiter, // but where it is switched off
    CameraIsWithinItsLimits,
    StateIsWhatIsFelt,             // goal at the hand, and force as written
    EnergyGivenToTheHandIsBounded, // joules, over the whole session
    RestingSurfaceDoesNotGiveWay,  // a constant press sinks no deeper than force by stiffness
    ViewIsReachable,               // in free space, after some seconds, the workspace fits the view
};

inline constexpr std::size_t kTouchInvariantCount = 7;

std::string_view touchInvariantName(TouchInvariant invariant) noexcept;

struct TouchSessionOptions {
    std::uint64_t seed = 1;
    double seconds = 4.0; // of random motion, before the press and the rest at the end
};

struct TouchSessionResult {
    std::array<std::uint64_t, kTouchInvariantCount> violations{}; // ticks or sessions
    std::string first;                                            // violation; empty: none
    std::uint64_t ticks = 0;
    std::uint64_t contact_ticks = 0;
    std::uint64_t pan_ticks = 0;
    std::uint64_t zoom_ticks = 0;
    std::uint64_t gliding_ticks = 0;
    double force_n_max = 0.0;
    double energy_j_max = 0.0; // given to the hand
    double sink_m_max = 0.0;   // at rest, beyond force by stiffness

    void add(const TouchSessionResult& other);
    std::uint64_t violationCount() const noexcept;
};

/// Strokes, presses, grabs in contact and in the air, flings, twists, changes and removals of the
/// map, and flights of the camera; then a constant press on the map at rest, and a rest in free
/// space. A pure function.
TouchSessionResult runTouchSession(const TouchSessionOptions& options);

} // namespace marsview
