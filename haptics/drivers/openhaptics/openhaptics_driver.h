// PHANTOM and Touch devices through the vendor's library.
#pragma once

#include "haptics/device/device_driver.h"
#include "haptics/drivers/openhaptics/openhaptics_api.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

struct OpenHapticsOptions {
    std::vector<std::string> libraries; // files or names of libHD, tried in this order
    /// The folders in which the vendor's setup programs keep one file per device.
    std::vector<std::filesystem::path> config_folders;
    std::filesystem::path lock_folder;
    std::chrono::milliseconds patience{20'000}; // for opening a device, including its homing

    /// $MARSVIEW_OPENHAPTICS_LIBRARY before the usual library names. Device folders:
    /// $GTDD_HOME/config, ~/.3dsystems/config and /usr/share/3DSystems/config, which hold "Default
    /// Device.config" and one file for every other name, and /etc/SensAble/PHANToMDeviceDrivers of
    /// the older FireWire drivers, whose default device is called "Default PHANToM".
    static OpenHapticsOptions standard();
};

/// "openhaptics:Default Device" opens a device by its name in the vendor's setup program;
/// "openhaptics:" opens the default one. Append ",home" to reset the encoders of a device that is
/// held in its neutral position (PHANTOM Premium).
class OpenHapticsDriver final : public DeviceDriver {
public:
    explicit OpenHapticsDriver(OpenHapticsOptions options = OpenHapticsOptions::standard());

    std::string_view scheme() const noexcept override { return "openhaptics"; }
    /// The configured devices; whether one is connected is known only when it is opened.
    std::vector<FoundDevice> find() override;
    Result<std::unique_ptr<HapticDevice>> open(std::string_view address) override;

private:
    Result<std::shared_ptr<OpenHapticsApi>> load();

    OpenHapticsOptions options_;
    std::shared_ptr<OpenHapticsApi> api_;
    std::string complaint_; // of the dynamic loader, if no library could be loaded
};

} // namespace marsview
