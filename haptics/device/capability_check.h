// Checks whether the capabilities that a device reports are plausible.
#pragma once

#include "haptics/device/haptic_device.h"

#include <optional>
#include <string>

namespace marsview {

/// The first implausible capability, phrased to follow the device's name: "states a peak force of
/// -3 N". Empty if all are plausible: finite numbers, a workspace of 1 mm to 10 m along every axis
/// and at most 10 m away, forces of at most 1000 N, stiffness of at most 1e6 N/m, 200 to 10000 Hz,
/// 1 to 6 input axes, at most 6 output axes and 32 buttons. A stiffness of 0 means "not stated".
std::optional<std::string> impossibilityOf(const DeviceCapabilities& capabilities);

} // namespace marsview
