// A driver: finds the connected devices of one kind and opens them.
#pragma once

#include "core/base/result.h"
#include "haptics/device/haptic_device.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

/// A device that can be opened, or the reason why it cannot.
struct FoundDevice {
    std::string uri;  // "sim:", "polhem:serial=4711"; stable across sessions where possible
    std::string name; // for people
    /// One sentence: why the device cannot be used. Empty if it can. With is_reason_past: what went
    /// wrong with this usable device last time.
    std::string reason;
    bool is_reason_past = false; // the reason is from the last use and may no longer apply
    std::string details{};       // what the system reported, for troubleshooting
    bool isUsable() const noexcept { return reason.empty() || is_reason_past; }
    /// Whether `wanted` selects this device: its URI, with or without options after a comma, or
    /// only its scheme, which selects the first device.
    bool isMeantBy(std::string_view wanted) const noexcept;
};

/// Devices are named by URIs: the driver's scheme, a colon, and a driver-specific address: "null:",
/// "sim:mass=0.1,delay_ms=2", "replay:goals.csv". One thread at a time.
class DeviceDriver {
public:
    virtual ~DeviceDriver() = default;
    DeviceDriver(const DeviceDriver&) = delete;
    DeviceDriver& operator=(const DeviceDriver&) = delete;

    virtual std::string_view scheme() const noexcept = 0;
    /// All devices connected now, usable or not. May take as long as a scan of the bus.
    virtual std::vector<FoundDevice> find() = 0;
    /// Whether `address`, the URI without scheme and colon, has the form that open() accepts. Looks
    /// for no device and no file. The error names the URI.
    virtual Status checkAddress(std::string_view /*address*/) const { return Done{}; }
    /// Opens the device with that address. The error names the URI.
    virtual Result<std::unique_ptr<HapticDevice>> open(std::string_view address) = 0;

protected:
    DeviceDriver() = default;
};

} // namespace marsview
