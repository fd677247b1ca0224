// A device that is not there: it rests in the middle of a desktop device's workspace, and what is
// written to it goes nowhere. For trying a loop without anything that moves.
#pragma once

#include "haptics/device/device_driver.h"

#include <memory>

namespace marsview {

/// Scheme "null"; no parameters.
std::unique_ptr<DeviceDriver> makeNullDriver();

} // namespace marsview
