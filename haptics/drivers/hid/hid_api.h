// The hidapi functions that drivers use, as a table that tests can replace: test machines have no
// HID devices.
#pragma once

#include <cstddef>

struct hid_device_;
struct hid_device_info;

namespace marsview {

/// As in hidapi.h. Reading and writing one device is for one thread; enumerating and opening are
/// for one thread at a time (hid_list.h takes a lock).
struct HidApi {
    hid_device_info* (*enumerate)(unsigned short vendor, unsigned short product);
    void (*free_enumeration)(hid_device_info* devices);
    hid_device_* (*open_path)(const char* path);
    void (*close)(hid_device_* device);
    int (*read_timeout)(hid_device_* device, unsigned char* data, std::size_t bytes, int ms);
    int (*write)(hid_device_* device, const unsigned char* data, std::size_t bytes);
    /// The error that opening the path would give: 0 or an errno value.
    int (*access_error)(const char* path);
};

/// hidapi with the kernel's hidraw.
const HidApi& systemHidApi();

} // namespace marsview
