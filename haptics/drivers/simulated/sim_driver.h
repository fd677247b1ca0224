// A simulated hand as a device: deterministic strokes pressed onto the surface.
#pragma once

#include "haptics/device/device_driver.h"
#include "haptics/drivers/simulated/simulated_hand.h"

#include <memory>

namespace marsview {

struct SimOptions {
    HandOptions hand;
    double force_n_peak = 3.3;
    double stiffness_n_per_m_max = 500.0;
    double speed_m_per_s = 0.05;  // of its strokes
    double press_n = 0.7;         // onto the surface
    double lift_s = 5.0;          // interval at which it leaves the surface for a moment; 0: never
    double grab_s = 0.0;          // interval at which it holds the button for a moment; 0: never
    double twist_deg_per_s = 0.0; // of the stylus while it holds the button, counterclockwise
    double rate_hz = 1000.0;
};

/// Each read advances the simulation by one period: the motion depends on the number of reads and
/// not on a clock.
class SimDevice final : public HapticDevice {
public:
    explicit SimDevice(const SimOptions& options);

    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override;
    DeviceStatus write(const Vec3& force_n) noexcept override;
    /// A hand outside the box lifts off and moves into it at once, within some tenths of a second.
    /// It presses no deeper than the lower side; the upper one is ignored.
    void strokeWithin(const WorkspaceBox& box) noexcept override;

private:
    void wander() noexcept;

    SimOptions options_;
    DeviceCapabilities capabilities_;
    SimulatedHand hand_;
    std::uint64_t random_state_;
    WorkspaceBox strokes_; // strokes reverse at these sides
    WorkspacePoint aim_{};
    double heading_rad_ = 0.0;
    double turn_rad_per_s_ = 0.0;
    double until_turn_s_ = 0.0;
    double lift_from_m_ = 0.0; // the height at which a lift begins
    double twist_rad_ = 0.0;
};

/// Scheme "sim". The address is a list like "mass=0.1,delay_ms=2,seed=3". Names: mass (kg), damping
/// (N s/m), grip (N/m), tremor_mm, encoder_mm, delay_ms, seed, force (N), stiffness (N/m), press
/// (N), lift_s, grab_s, twist (degrees per second), speed (m/s); or, instead of speed, swipe (cells
/// per update) with cell_m (width of a cell in workspace meters, which `marsview-cli loop` adds).
std::unique_ptr<DeviceDriver> makeSimDriver();

} // namespace marsview
