// A simulated hand as a device: it strokes over the ground and presses, the same way every time.
#pragma once

#include "haptics/device/device_driver.h"
#include "haptics/drivers/simulated_hand.h"

#include <memory>

namespace marsview {

struct SimOptions {
    HandOptions hand;
    double force_n_peak = 3.3;
    double stiffness_n_per_m_max = 500.0;
    double speed_m_per_s = 0.05; // of its strokes
    double press_n = 0.7;        // onto the ground
    double lift_s = 5.0;         // every so often it leaves the ground for a moment; 0: never
    double grab_s = 0.0;         // every so often it holds the button for a moment; 0: never
    double rate_hz = 1000.0;
};

/// Moves on by one period with each read: what it does depends on how often it is read, and not on
/// any clock.
class SimDevice final : public HapticDevice {
public:
    explicit SimDevice(const SimOptions& options);

    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override;
    DeviceStatus write(const Vec3& force_n) noexcept override;
    /// A hand that is outside moves there at once, in some tenths of a second. Heights are ignored.
    void strokeWithin(const WorkspaceBox& box) noexcept override;

private:
    void wander() noexcept;

    SimOptions options_;
    DeviceCapabilities capabilities_;
    SimulatedHand hand_;
    std::uint64_t random_state_;
    WorkspaceBox strokes_; // turns back at these sides
    WorkspacePoint aim_{};
    double heading_rad_ = 0.0;
    double turn_rad_per_s_ = 0.0;
    double until_turn_s_ = 0.0;
};

/// Scheme "sim". Its address is a list like "mass=0.1,delay_ms=2,seed=3". Names: mass (kg), damping
/// (N s/m), grip (N/m), tremor_mm, encoder_mm, delay_ms, seed, force (N), stiffness (N/m), press
/// (N), lift_s, grab_s, speed (m/s); or, in its place, swipe (cells an update) with cell_m (metres
/// of the workspace that a cell is wide, which `marsview-cli loop` adds).
std::unique_ptr<DeviceDriver> makeSimDriver();

} // namespace marsview
