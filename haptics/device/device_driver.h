// What knows one kind of device: finds those that are there, and opens them.
#pragma once

#include "core/base/result.h"
#include "haptics/device/haptic_device.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

/// A device that could be opened, or why it cannot.
struct FoundDevice {
    std::string uri;  // "sim:", "polhem:serial=4711"; what opens it, tomorrow too where possible
    std::string name; // for people
    /// Why it cannot be used, one sentence; empty where it can. Of a usable one, what went wrong
    /// the last time.
    std::string reason;
    bool is_reason_past = false; // it may be otherwise this time
    std::string details{};       // what the system reported, for those who look into it
    bool isUsable() const noexcept { return reason.empty() || is_reason_past; }
    /// Whether `wanted` may open this one: its URI, with options after a comma or without, or no
    /// more than its scheme, for the first.
    bool isMeantBy(std::string_view wanted) const noexcept;
};

/// Devices are named by URIs: the driver's scheme, a colon, and what only the driver understands:
/// "null:", "sim:mass=0.1,delay_ms=2", "replay:goals.csv". For one thread at a time.
class DeviceDriver {
public:
    virtual ~DeviceDriver() = default;
    DeviceDriver(const DeviceDriver&) = delete;
    DeviceDriver& operator=(const DeviceDriver&) = delete;

    virtual std::string_view scheme() const noexcept = 0;
    /// What is there now, usable or not. May take as long as looking at a bus does.
    virtual std::vector<FoundDevice> find() = 0;
    /// `address` is the URI without scheme and colon. The error names the URI.
    virtual Result<std::unique_ptr<HapticDevice>> open(std::string_view address) = 0;

protected:
    DeviceDriver() = default;
};

} // namespace marsview
