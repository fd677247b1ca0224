// Whether what a device says of itself can be true.
#pragma once

#include "haptics/device/haptic_device.h"

#include <optional>
#include <string>

namespace marsview {

/// What is impossible about it, to be put after the device's name: "states a peak force of -3 N".
/// Nothing where all is well: finite numbers, a workspace of 1 mm to 10 m along every axis and at
/// most 10 m away, forces of at most 1000 N, stiffness of at most 1e6 N/m, 200 to 10000 Hz, 1 to
/// 6 axes in, at most 6 out and 32 buttons. A stiffness of 0 is one that is not stated.
std::optional<std::string> impossibilityOf(const DeviceCapabilities& capabilities);

} // namespace marsview
