// A model of a hand that holds a stylus: for tests, benchmarks, and use without a device.
#pragma once

#include "haptics/device/workspace.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace marsview {

/// Device and hand together are a mass with damping; the fingers act as a spring toward the aim.
/// The defaults are close to published values for a light grip.
struct HandOptions {
    double mass_kg = 0.1;
    double damping_n_s_per_m = 2.0; // against the room: bearings and arm
    double grip_n_per_m = 150.0;    // toward the aim
    double grip_n_s_per_m = 2.0;    // relative to the aim's velocity
    double tremor_m = 0.0;          // amplitude of the aim's tremor, 8 to 12 Hz
    double encoder_m = 0.0;         // measured positions are multiples of this; 0: exact
    double delay_s = 0.0;           // from push() to the motors; at most kDelayMax
    std::uint64_t seed = 1;         // for the tremor

    static constexpr double kDelayMaxS = 0.05;
};

/// The mass on its springs; its state advances only with simulated time. Deterministic: the same
/// calls give the same bits. Does not allocate; one thread at a time, including the servo thread.
class SimulatedHand {
public:
    explicit SimulatedHand(const HandOptions& options, const WorkspacePoint& at = {}) noexcept;

    /// Sets the position that the hand moves toward, and that position's velocity.
    void aimAt(const WorkspacePoint& aim, const Vec3& aim_m_per_s = {}) noexcept;
    /// The force that the program writes now. It acts after the delay.
    void push(const Vec3& force_n) noexcept;
    /// Advances by `seconds`, 0 to 0.1, in steps of at most 0.1 ms, semi-implicitly.
    void advance(double seconds) noexcept;

    /// The position that the device reports.
    WorkspacePoint measured() const noexcept;
    /// The true position of the stylus.
    const WorkspacePoint& position() const noexcept { return at_; }
    const Vec3& velocity() const noexcept { return velocity_m_per_s_; } // m/s
    /// Kinetic energy plus the energy of the grip's spring, in joules.
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
    std::array<Push, kPushesMax> pushes_{}; // a ring of forces that do not act yet
    std::size_t first_ = 0;
    std::size_t count_ = 0;
    std::array<double, 3> phases_{}; // of the tremor, along each axis
    std::array<double, 3> rad_per_s_{};
};

} // namespace marsview
