// Formats the output of `devices`.
#pragma once

#include "haptics/device/device_driver.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace marsview {

/// A heading, and one line per device: URI, name, and either "ready", with the last problem if any,
/// or the reason why it cannot be used.
std::string devicesAsTable(const std::vector<FoundDevice>& devices);

nlohmann::ordered_json devicesAsJson(const std::vector<FoundDevice>& devices,
                                     const std::vector<std::string>& schemes);

} // namespace marsview
