// PHANTOM and Touch devices through the vendor's library.
#pragma once

#include "haptics/device/device_driver.h"
#include "haptics/drivers/openhaptics_api.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

struct OpenHapticsOptions {
    std::vector<std::string> libraries; // files or names of libHD, tried in this order
    /// Where the vendor's setup programs leave a file per device.
    std::vector<std::filesystem::path> config_folders;
    std::filesystem::path lock_folder;
    std::chrono::milliseconds patience{20'000}; // for opening a device, which homes itself

    /// $MARSVIEW_OPENHAPTICS_LIBRARY before the usual names. For devices $GTDD_HOME/config,
    /// ~/.3dsystems/config and /usr/share/3DSystems/config, which hold "Default Device.config" and
    /// one file for every other name, and for those of FireWire days
    /// /etc/SensAble/PHANToMDeviceDrivers, whose default is called "Default PHANToM".
    static OpenHapticsOptions standard();
};

/// "openhaptics:Default Device", by the name that the device was given in the vendor's setup
/// program; "openhaptics:" is the default one.
class OpenHapticsDriver final : public DeviceDriver {
public:
    explicit OpenHapticsDriver(OpenHapticsOptions options = OpenHapticsOptions::standard());

    std::string_view scheme() const noexcept override { return "openhaptics"; }
    /// What is configured; whether it is connected shows when it is opened.
    std::vector<FoundDevice> find() override;
    Result<std::unique_ptr<HapticDevice>> open(std::string_view address) override;

private:
    Result<std::shared_ptr<OpenHapticsApi>> load();

    OpenHapticsOptions options_;
    std::shared_ptr<OpenHapticsApi> api_;
    std::string complaint_; // of the dynamic loader, while there is none
};

} // namespace marsview
