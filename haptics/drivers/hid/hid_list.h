// Lists the connected HID devices of interest.
#pragma once

#include "core/base/result.h"
#include "haptics/drivers/hid/hid_api.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

struct HidEntry {
    std::string path; // "/dev/hidraw3": may differ each time it is plugged in
    std::string product;
    std::string serial; // letters, digits, "-", "_" and "."; empty if it has none
    std::uint16_t vendor_id = 0;
    std::uint16_t product_id = 0;
    std::uint16_t usage_page = 0; // 0: unknown
    std::uint16_t usage = 0;
    int interface_number = -1; // -1: unknown
};

/// All HID devices for which `is_wanted` is true, each path once. Any thread; may take as long as a
/// scan of the bus.
std::vector<HidEntry> hidDevices(const HidApi& api,
                                 const std::function<bool(const HidEntry&)>& is_wanted);

/// Why a listed device cannot be opened, as one sentence without its name; empty if nothing
/// prevents it.
std::string refusalToOpen(const HidApi& api, const std::string& path);

/// An open device; closed when the last copy is destroyed.
using HidHandle = std::shared_ptr<hid_device_>;

/// The error begins with `uri`. Any thread.
Result<HidHandle> openHid(const HidApi& api, const std::string& path, std::string_view uri);

} // namespace marsview
