// All drivers together: what devices are there, and the way to open one by its URI.
#pragma once

#include "haptics/device/device_driver.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

/// Owns the drivers. For one thread at a time; devices that it opened live on without it.
class DeviceRegistry {
public:
    /// The schemes of the drivers differ.
    explicit DeviceRegistry(std::vector<std::unique_ptr<DeviceDriver>> drivers);

    /// What all drivers find, in their order: devices, and what cannot be used with the reason why.
    /// Takes as long as looking at the buses does.
    std::vector<FoundDevice> find();

    /// Opens "scheme:address". Unsupported, with the known schemes, where no driver has the scheme;
    /// otherwise what the driver says.
    Result<std::unique_ptr<HapticDevice>> open(std::string_view uri);

    /// In the drivers' order.
    std::vector<std::string> schemes() const;

private:
    std::vector<std::unique_ptr<DeviceDriver>> drivers_;
};

} // namespace marsview
