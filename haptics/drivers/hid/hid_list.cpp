#include "haptics/drivers/hid/hid_list.h"

#include <hidapi.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <mutex>

namespace marsview {
namespace {

// hidapi keeps the error of enumerating and opening in one place for all threads.
std::mutex& hidMutex()
{
    static std::mutex mutex;
    return mutex;
}

// Product names are ASCII on all known devices.
std::string asAscii(const wchar_t* text)
{
    std::string ascii;
    for (; text != nullptr && *text != L'\0'; ++text) {
        ascii += *text >= L' ' && *text < 0x7F ? static_cast<char>(*text) : '?';
    }
    return ascii;
}

// Empty unless the serial number can be part of a URI, where commas and colons have a meaning.
std::string asSerial(const wchar_t* text)
{
    std::string serial = asAscii(text);
    const bool is_plain = std::all_of(serial.begin(), serial.end(), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               c == '-' || c == '_' || c == '.';
    });
    return is_plain ? serial : std::string();
}

} // namespace

std::vector<HidEntry> hidDevices(const HidApi& api,
                                 const std::function<bool(const HidEntry&)>& is_wanted)
{
    std::vector<HidEntry> wanted;
    const std::lock_guard one_at_a_time(hidMutex());
    hid_device_info* all = api.enumerate(0, 0);
    for (const hid_device_info* info = all; info != nullptr; info = info->next) {
        const HidEntry entry{.path = info->path != nullptr ? info->path : "",
                             .product = asAscii(info->product_string),
                             .serial = asSerial(info->serial_number),
                             .vendor_id = info->vendor_id,
                             .product_id = info->product_id,
                             .usage_page = info->usage_page,
                             .usage = info->usage,
                             .interface_number = info->interface_number};
        // hidapi lists a path once for each of its usages.
        const bool is_known = std::any_of(wanted.begin(), wanted.end(), [&](const HidEntry& other) {
            return other.path == entry.path;
        });
        if (!is_known && is_wanted(entry)) {
            wanted.push_back(entry);
        }
    }
    api.free_enumeration(all);
    return wanted;
}

std::string refusalToOpen(const HidApi& api, const std::string& path)
{
    const int error = api.access_error(path.c_str());
    if (error == 0) {
        return {};
    }
    if (error == EACCES || error == EPERM) {
        return fmt::format(
            "no permission to open {}; install 70-marsview-haptics.rules into "
            "/etc/udev/rules.d and plug the device in again",
            path);
    }
    return fmt::format("{} cannot be opened ({}); plug the device in again", path,
                       std::strerror(error)); // NOLINT(concurrency-mt-unsafe): glibc's is
}

Result<HidHandle> openHid(const HidApi& api, const std::string& path, std::string_view uri)
{
    if (std::string why = refusalToOpen(api, path); !why.empty()) {
        return Error{ErrorCode::Unreadable, fmt::format("{}: {}", uri, why)};
    }
    const std::lock_guard one_at_a_time(hidMutex());
    hid_device_* device = api.open_path(path.c_str());
    if (device == nullptr) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: {} is listed, but cannot be opened as a HID device; plug it "
                                 "in again",
                                 uri, path)};
    }
    return HidHandle(device, api.close);
}

} // namespace marsview
