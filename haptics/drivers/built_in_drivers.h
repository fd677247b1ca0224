// The drivers that come with the program, for a DeviceRegistry.
#pragma once

#include "haptics/device/device_driver.h"

#include <memory>
#include <vector>

namespace marsview {

/// One driver of each kind, in the order in which the user interface lists devices.
std::vector<std::unique_ptr<DeviceDriver>> builtInDrivers();

} // namespace marsview
