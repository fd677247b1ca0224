// What `devices` prints of what was found.
#pragma once

#include "haptics/device/device_driver.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace marsview {

/// A heading and a line each: URI, name, and "ready", with what went wrong the last time, or
/// why it cannot be used.
std::string devicesAsTable(const std::vector<FoundDevice>& devices);

nlohmann::ordered_json devicesAsJson(const std::vector<FoundDevice>& devices,
                                     const std::vector<std::string>& schemes);

} // namespace marsview
