// The drivers that come with the program, for a DeviceRegistry.
#pragma once

#include "haptics/device/device_driver.h"
#include "haptics/drivers/mouse/mouse_device.h"

#include <memory>
#include <vector>

namespace marsview {

/// One driver of each kind, in the order in which the user interface lists devices. `mouse` is the
/// link through which the window moves the mouse device; null without a window.
std::vector<std::unique_ptr<DeviceDriver>>
builtInDrivers(std::shared_ptr<MouseLink> mouse = nullptr);

} // namespace marsview
