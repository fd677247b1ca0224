// All drivers together: lists the devices and opens one by its URI.
#pragma once

#include "haptics/device/device_driver.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

/// Owns the drivers. One thread at a time; devices it has opened may outlive it.
class DeviceRegistry {
public:
    /// No two drivers have the same scheme.
    explicit DeviceRegistry(std::vector<std::unique_ptr<DeviceDriver>> drivers);

    /// The devices that all drivers find, in driver order, including unusable ones with the reason.
    /// May take as long as a scan of the buses.
    std::vector<FoundDevice> find();

    /// Whether `uri` has the form "scheme:address" of a known driver and the driver accepts the
    /// form of the address. Looks for no device and no file.
    Status check(std::string_view uri) const;

    /// Opens "scheme:address". Unsupported, listing the known schemes, if no driver has the scheme;
    /// otherwise the driver's result.
    Result<std::unique_ptr<HapticDevice>> open(std::string_view uri);

    /// In driver order.
    std::vector<std::string> schemes() const;

private:
    Result<DeviceDriver*> driverOf(std::string_view uri) const;

    std::vector<std::unique_ptr<DeviceDriver>> drivers_;
};

} // namespace marsview
