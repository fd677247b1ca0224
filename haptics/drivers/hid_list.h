// Which HID devices of interest are connected.
#pragma once

#include "core/base/result.h"
#include "haptics/drivers/hid_api.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

struct HidEntry {
    std::string path; // "/dev/hidraw3": another one after it was plugged in anew
    std::string product;
    std::string serial; // letters, digits, "-", "_" and "."; empty where it has no such number
    std::uint16_t vendor_id = 0;
    std::uint16_t product_id = 0;
    std::uint16_t usage_page = 0; // 0: unknown
    std::uint16_t usage = 0;
    int interface_number = -1; // -1: unknown
};

/// All HID devices that `is_wanted`, each path once. Any thread; may take as long as the bus does.
std::vector<HidEntry> hidDevices(const HidApi& api,
                                 const std::function<bool(const HidEntry&)>& is_wanted);

/// Why a device that is listed cannot be opened, one sentence without its name; empty where
/// nothing stands against it.
std::string refusalToOpen(const HidApi& api, const std::string& path);

/// An open device; closed with its last owner.
using HidHandle = std::shared_ptr<hid_device_>;

/// The error begins with `uri`. Any thread.
Result<HidHandle> openHid(const HidApi& api, const std::string& path, std::string_view uri);

} // namespace marsview
