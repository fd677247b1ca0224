// A wrapper that records a device's samples and forces to a file: for debugging a driver.
#pragma once

#include "haptics/device/device_driver.h"

#include <memory>
#include <string>
#include <string_view>

namespace marsview {

/// Scheme "record". The address is a file, a comma, and the URI of the device to record:
/// "record:touch.csv,openhaptics:". Writes one line per read(), in workspace coordinates, on its
/// own thread. (SessionRecorder records sessions over a map.)
std::unique_ptr<DeviceDriver> makeRecordDriver();

/// The file that such a device writes; empty for other URIs.
std::string recordedFile(std::string_view uri);

} // namespace marsview
