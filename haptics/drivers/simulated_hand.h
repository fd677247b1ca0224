// A hand that holds a stylus, as numbers: for tests, benchmarks, and trying out without a device.
#pragma once

#include "haptics/device/workspace.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace marsview {

/// Device and hand together are a mass with damping; the fingers hold it like a spring that is
/// drawn to where the hand means to be. About what is reported of hands that hold a stylus lightly.
struct HandOptions {
    double mass_kg = 0.1;
    double damping_n_s_per_m = 2.0; // against the room: bearings, and the arm's own
    double grip_n_per_m = 150.0;    // towards the aim
    double grip_n_s_per_m = 2.0;    // along with it
    double tremor_m = 0.0;          // amplitude of the aim's trembling, 8 to 12 Hz
    double encoder_m = 0.0;         // positions are told in steps of this; 0: exactly
    double delay_s = 0.0;           // from a force that is written to the motors; at most kDelayMax
    std::uint64_t seed = 1;         // of tremor

    static constexpr double kDelayMaxS = 0.05;
};

/// The mass on its springs, moved on by time alone. Deterministic: the same calls give the same
/// bits. Allocates nothing; one thread at a time, the servo's too.
class SimulatedHand {
public:
    explicit SimulatedHand(const HandOptions& options, const WorkspacePoint& at = {}) noexcept;

    /// Where the hand means to be from now on, and how fast that moves.
    void aimAt(const WorkspacePoint& aim, const Vec3& aim_m_per_s = {}) noexcept;
    /// The force that the program writes now. It acts after the delay.
    void push(const Vec3& force_n) noexcept;
    /// `seconds` later, 0 to 0.1: in steps of at most 0.1 ms, semi-implicit.
    void advance(double seconds) noexcept;

    /// What the device tells.
    WorkspacePoint measured() const noexcept;
    /// Where the stylus is.
    const WorkspacePoint& position() const noexcept { return at_; }
    const Vec3& velocity() const noexcept { return velocity_m_per_s_; } // m/s
    /// Of motion and of the grip's spring, in joules.
    double energyJ() const noexcept;
    double seconds() const noexcept { return seconds_; }

private:
    struct Push {
        double begin_s = 0.0;
        Vec3 force_n{};
    };
    static constexpr std::size_t kPushesMax = 256;

    void step(double seconds) noexcept;
    Vec3 tremor() const noexcept;

    HandOptions options_;
    WorkspacePoint aim_{};
    Vec3 aim_m_per_s_{};
    WorkspacePoint at_;
    Vec3 velocity_m_per_s_{};
    double seconds_ = 0.0;
    Vec3 acting_n_{};
    std::array<Push, kPushesMax> pushes_{}; // a ring, of those that do not act yet
    std::size_t first_ = 0;
    std::size_t count_ = 0;
    std::array<double, 3> phases_{}; // of the tremor, along each axis
    std::array<double, 3> rad_per_s_{};
};

} // namespace marsview
