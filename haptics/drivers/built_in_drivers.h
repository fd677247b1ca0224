// The drivers that come with the program, for a DeviceRegistry.
#pragma once

#include "haptics/device/device_driver.h"

#include <memory>
#include <vector>

namespace marsview {

/// One of each, in the order in which people want to see their devices.
std::vector<std::unique_ptr<DeviceDriver>> builtInDrivers();

} // namespace marsview
