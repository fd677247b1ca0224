// A placeholder device: it stays in the middle of a desktop device's workspace and discards forces.
// For running a loop without moving parts.
#pragma once

#include "haptics/device/device_driver.h"

#include <memory>

namespace marsview {

/// Scheme "null"; no parameters.
std::unique_ptr<DeviceDriver> makeNullDriver();

} // namespace marsview
