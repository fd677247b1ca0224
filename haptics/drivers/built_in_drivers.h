// The drivers that come with the program, for a DeviceRegistry.
#pragma once

#include "haptics/device/device_driver.h"
#include "haptics/drivers/mouse_device.h"

#include <memory>
#include <vector>

namespace marsview {

/// One of each, in the order in which people want to see their devices. `mouse` is what the window
/// moves; null where there is none.
std::vector<std::unique_ptr<DeviceDriver>>
builtInDrivers(std::shared_ptr<MouseLink> mouse = nullptr);

} // namespace marsview
