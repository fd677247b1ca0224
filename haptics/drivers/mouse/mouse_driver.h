// Opens the mouse of the program's window by URI.
#pragma once

#include "haptics/device/device_driver.h"
#include "haptics/drivers/mouse/mouse_device.h"

#include <memory>
#include <string_view>
#include <vector>

namespace marsview {

/// "mouse:". Without a link to a window the device is listed as unusable, with the reason.
class MouseDriver final : public DeviceDriver {
public:
    explicit MouseDriver(std::shared_ptr<MouseLink> link);

    std::string_view scheme() const noexcept override { return "mouse"; }
    std::vector<FoundDevice> find() override;
    Result<std::unique_ptr<HapticDevice>> open(std::string_view address) override;

private:
    std::shared_ptr<MouseLink> link_;
};

} // namespace marsview
