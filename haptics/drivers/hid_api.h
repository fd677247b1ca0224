// The functions of hidapi that drivers use, as a table that tests replace: no machine that only
// tests has a HID device.
#pragma once

#include <cstddef>

struct hid_device_;
struct hid_device_info;

namespace marsview {

/// As in hidapi.h. Reading and writing one device is for one thread; enumerating and opening for
/// one at a time, which hid_list.h sees to.
struct HidApi {
    hid_device_info* (*enumerate)(unsigned short vendor, unsigned short product);
    void (*free_enumeration)(hid_device_info* devices);
    hid_device_* (*open_path)(const char* path);
    void (*close)(hid_device_* device);
    int (*read_timeout)(hid_device_* device, unsigned char* data, std::size_t bytes, int ms);
    int (*write)(hid_device_* device, const unsigned char* data, std::size_t bytes);
    /// What hidapi's access to the path would meet: 0 or an error number.
    int (*access_error)(const char* path);
};

/// hidapi over the kernel's hidraw.
const HidApi& systemHidApi();

} // namespace marsview
