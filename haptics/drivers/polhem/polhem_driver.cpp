#include "haptics/drivers/polhem/polhem_driver.h"

#include "core/base/bundled_file.h"
#include "core/base/environment.h"
#include "haptics/device/capability_check.h"
#include "haptics/device/checked_device.h"
#include "haptics/device/device_lock.h"
#include "haptics/drivers/hid/hid_list.h"
#include "haptics/drivers/polhem/polhem_device.h"
#include "haptics/drivers/polhem/polhem_parameters.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;

// Any Teensy-based gadget may have these numbers, so nothing is sent before the user connects to
// it. The second interface of such a board is a serial port.
constexpr std::uint16_t kTeensyVendor = 0x16C0;
constexpr std::uint16_t kTeensyRawHid = 0x0486;
constexpr std::uint16_t kRawHidUsagePage = 0xFFAB;
constexpr std::uint16_t kOlderVendor = 0x1234;
constexpr std::uint16_t kOlderProduct = 0x0006;

bool isTeensy(const HidEntry& entry)
{
    return entry.vendor_id == kTeensyVendor && entry.product_id == kTeensyRawHid &&
           (entry.usage_page == kRawHidUsagePage ||
            (entry.usage_page == 0 && entry.interface_number <= 0));
}

bool isArm(const HidEntry& entry)
{
    return isTeensy(entry) ||
           (entry.vendor_id == kOlderVendor && entry.product_id == kOlderProduct);
}

// A stable name independent of the path: the board's serial number, or else the USB ids.
std::string lastingName(const HidEntry& entry)
{
    return entry.serial.empty()
               ? fmt::format("usb={:04x}:{:04x}", entry.vendor_id, entry.product_id)
               : fmt::format("serial={}", entry.serial);
}

bool isNamed(const HidEntry& entry, std::string_view name)
{
    return name.empty() || (name.front() == '/' ? entry.path : lastingName(entry)) == name;
}

// One sentence that lists the matching devices.
std::string refusalToChoose(std::string_view uri, const std::vector<HidEntry>& arms)
{
    std::vector<std::string> uris;
    for (const HidEntry& arm : arms) {
        uris.push_back("polhem:" + arm.path);
    }
    return fmt::format("{}: {} devices match that name; choose one by its path: {}", uri,
                       arms.size(), fmt::join(uris, " or "));
}

struct Address {
    std::string name; // a path, a name from lastingName(), or empty for any
    fs::path parameters;
    bool homes_at_once = false;
};

Result<Address> parseAddress(std::string_view uri, std::string_view address)
{
    constexpr std::string_view kParameters = "parameters=";
    Address parsed;
    bool is_first = true;
    while (is_first || !address.empty()) {
        const std::string_view part = address.substr(0, address.find(','));
        address.remove_prefix(std::min(part.size() + 1, address.size()));
        if (is_first && (part.empty() || part.front() == '/' || part.starts_with("serial=") ||
                         part.starts_with("usb="))) {
            parsed.name = part;
        } else if (part == "home") {
            parsed.homes_at_once = true;
        } else if (part.starts_with(kParameters)) {
            parsed.parameters = part.substr(kParameters.size());
        } else {
            return Error{ErrorCode::Invalid,
                         fmt::format("{}: unknown part \"{}\"; use a path, \"serial=NUMBER\", "
                                     "\"home\" or \"parameters=FILE\"",
                                     uri, part)};
        }
        is_first = false;
    }
    return parsed;
}

} // namespace

PolhemOptions PolhemOptions::standard()
{
    PolhemOptions options;
    options.parameter_files = {userFolder("XDG_CONFIG_HOME", ".config") / "marsview" / "devices" /
                                   "polhem.json",
                               bundledFile("devices/polhem-v1.json")};
    options.lock_folder = deviceLockFolder();
    return options;
}

PolhemDriver::PolhemDriver(PolhemOptions options)
    : options_(std::move(options))
{}

std::vector<FoundDevice> PolhemDriver::find()
{
    std::vector<FoundDevice> found;
    const std::vector<HidEntry> arms = hidDevices(*options_.api, isArm);
    for (const HidEntry& entry : arms) {
        // Devices that cannot be distinguished otherwise are named by their current paths.
        const std::string name = lastingName(entry);
        const bool is_alone = std::count_if(arms.begin(), arms.end(), [&](const HidEntry& other) {
                                  return lastingName(other) == name;
                              }) == 1;
        found.push_back({fmt::format("{}:{}", scheme(), is_alone ? name : entry.path),
                         fmt::format("WoodenHaptics or Polhem ({})",
                                     entry.product.empty() ? "no name" : entry.product),
                         refusalToOpen(*options_.api, entry.path)});
    }
    return found;
}

Status PolhemDriver::checkAddress(std::string_view address) const
{
    const Result<Address> parsed = parseAddress(fmt::format("{}:{}", scheme(), address), address);
    return parsed ? Status(Done{}) : parsed.error();
}

Result<std::unique_ptr<HapticDevice>> PolhemDriver::open(std::string_view address)
{
    const std::string uri = fmt::format("{}:{}", scheme(), address);
    Result<Address> parsed = parseAddress(uri, address);
    if (!parsed) {
        return std::move(parsed).error();
    }
    const std::vector<HidEntry> arms = hidDevices(*options_.api, [&](const HidEntry& entry) {
        return isArm(entry) && isNamed(entry, parsed->name);
    });
    if (arms.empty()) {
        return Error{ErrorCode::NotFound,
                     fmt::format("{}: no matching WoodenHaptics or Polhem device is connected; "
                                 "plug it in, and see marsview-cli devices",
                                 uri)};
    }
    if (!parsed->name.empty() && arms.size() > 1) {
        return Error{ErrorCode::Invalid, refusalToChoose(uri, arms)};
    }
    if (parsed->parameters.empty()) {
        const auto file = std::find_if(options_.parameter_files.begin(),
                                       options_.parameter_files.end(), [](const fs::path& path) {
                                           std::error_code none;
                                           return fs::exists(path, none);
                                       });
        parsed->parameters = file != options_.parameter_files.end() ? *file : "polhem-v1.json";
    }
    Result<PolhemParameters> parameters = readPolhemParameters(parsed->parameters);
    if (!parameters) {
        return std::move(parameters).error();
    }
    Result<std::optional<FileLock>> lock =
        lockDevice(fmt::format("{}:{}", scheme(), arms.front().path), options_.lock_folder);
    if (!lock) {
        return std::move(lock).error();
    }
    Result<HidHandle> handle = openHid(*options_.api, arms.front().path, uri);
    if (!handle) {
        return std::move(handle).error();
    }
    auto device = std::make_unique<PolhemDevice>(PolhemDevice::Options{
        .api = options_.api,
        .handle = std::move(*handle),
        .layout = isTeensy(arms.front()) ? PolhemLayout::RawHid : PolhemLayout::Short,
        .parameters = std::move(*parameters),
        .homes_at_once = parsed->homes_at_once,
        .lock = std::move(*lock)});
    if (const auto fault = impossibilityOf(device->capabilities())) {
        return Error{ErrorCode::Invalid, fmt::format("{}: {}, which is implausible",
                                                     parsed->parameters.string(), *fault)};
    }
    return std::unique_ptr<HapticDevice>(std::make_unique<CheckedDevice>(std::move(device)));
}

} // namespace marsview
