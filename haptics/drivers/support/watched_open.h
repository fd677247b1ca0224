// Opening a device with a vendor's library that may never return.
#pragma once

#include "haptics/device/haptic_device.h"
#include "haptics/device/watched_call.h"

#include <chrono>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace marsview {

/// Device::open(options) on its own thread, for at most `patience`. The errors name options.uri.
template <typename Device>
Result<std::unique_ptr<HapticDevice>> openWatched(typename Device::Options options,
                                                  std::chrono::milliseconds patience)
{
    using Opened = Result<std::unique_ptr<HapticDevice>>;
    const std::string uri = options.uri;
    std::optional<Opened> device =
        callWatched(patience, [options = std::move(options)]() mutable -> Opened {
            return Device::open(std::move(options));
        });
    if (!device) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: the vendor's library did not open it within {} s; check the "
                                 "device's power and start the program again",
                                 uri, patience.count() / 1000)};
    }
    return std::move(*device);
}

} // namespace marsview
