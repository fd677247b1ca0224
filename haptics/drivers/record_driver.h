// Any device, and a file of what it measured and what was written to it: for looking into a driver.
#pragma once

#include "haptics/device/device_driver.h"

#include <memory>
#include <string>
#include <string_view>

namespace marsview {

/// Scheme "record". The address is a file, a comma, and the URI of the device that is recorded:
/// "record:touch.csv,openhaptics:". A line each time the device is read, in its workspace; a
/// session over a map is recorded by SessionRecorder instead. A thread of its own writes.
std::unique_ptr<DeviceDriver> makeRecordDriver();

/// The file that such a device writes; empty for any other device.
std::string recordedFile(std::string_view uri);

} // namespace marsview
