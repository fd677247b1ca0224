#include "haptics/device/capability_check.h"

#include <array>
#include <cmath>
#include <fmt/format.h>

namespace marsview {
namespace {

// Generous bounds: values beyond them come from wrong units or uninitialized memory.
constexpr double kSideMMin = 0.001;
constexpr double kReachMMax = 10.0;
constexpr double kForceNMax = 1000.0;
constexpr double kTorqueNmMax = 1000.0;
constexpr double kStiffnessMax = 1e6;
constexpr double kRateHzMin = 200.0; // a force would stay on too long between two samples
constexpr double kRateHzMax = 10'000.0;
constexpr unsigned kAxesMax = 6;
constexpr unsigned kButtonsMax = 32;

struct Bound {
    const char* what;
    double value;
    const char* unit;
    double low;
    double high;
};

// Also true for NaN.
bool isOutside(double value, double low, double high)
{
    return !(value >= low && value <= high);
}

} // namespace

std::optional<std::string> impossibilityOf(const DeviceCapabilities& c)
{
    struct Side {
        char axis;
        double low_m;
        double high_m;
    };
    for (const Side& side : {Side{'x', c.workspace.low.x, c.workspace.high.x},
                             Side{'y', c.workspace.low.y, c.workspace.high.y},
                             Side{'z', c.workspace.low.z, c.workspace.high.z}}) {
        if (isOutside(side.low_m, -kReachMMax, kReachMMax) ||
            isOutside(side.high_m, -kReachMMax, kReachMMax) ||
            isOutside(side.high_m - side.low_m, kSideMMin, 2.0 * kReachMMax)) {
            return fmt::format("states a workspace from {} to {} m along {}", side.low_m,
                               side.high_m, side.axis);
        }
    }
    for (const Bound& bound :
         {Bound{"peak force", c.force_n_peak, "N", 0.0, kForceNMax},
          Bound{"continuous force", c.force_n_continuous, "N", 0.0, kForceNMax},
          Bound{"peak torque", c.torque_nm_peak, "N·m", 0.0, kTorqueNmMax},
          Bound{"maximum stiffness", c.stiffness_n_per_m_max, "N/m", 0.0, kStiffnessMax},
          Bound{"rate", c.rate_hz, "Hz", kRateHzMin, kRateHzMax}}) {
        if (isOutside(bound.value, bound.low, bound.high)) {
            const double value = std::isnan(bound.value) ? std::abs(bound.value) : bound.value;
            return fmt::format("states a {} of {} {}", bound.what, value, bound.unit);
        }
    }
    if (c.force_n_continuous > c.force_n_peak) {
        return fmt::format("states a continuous force of {} N above its peak force of {} N",
                           c.force_n_continuous, c.force_n_peak);
    }
    if (c.axes_in < 1 || c.axes_in > kAxesMax || c.axes_out > kAxesMax) {
        return fmt::format("states {} axes in and {} out", c.axes_in, c.axes_out);
    }
    if (c.buttons > kButtonsMax) {
        return fmt::format("states {} buttons", c.buttons);
    }
    return std::nullopt;
}

} // namespace marsview
