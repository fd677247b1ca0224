// WoodenHaptics and Polhem devices over USB HID.
#pragma once

#include "haptics/device/device_driver.h"
#include "haptics/drivers/hid/hid_api.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

struct PolhemOptions {
    const HidApi* api = &systemHidApi();
    /// Parameter files (polhem_parameters.h); the first that exists is used.
    std::vector<std::filesystem::path> parameter_files;
    std::filesystem::path lock_folder;

    /// $XDG_CONFIG_HOME/marsview/devices/polhem.json, else ~/.config/…, else the bundled one.
    static PolhemOptions standard();
};

/// "polhem:serial=4711" finds the device whatever its path is; "polhem:usb=1234:0006" does the same
/// for a device without a serial number if it is the only one of its kind. Invalid, listing the
/// paths to choose from, if several devices match. "polhem:/dev/hidraw2" opens a path, and
/// "polhem:" the first device. Append ",home" to calibrate a device that is in its home position
/// without its board's button (PolhemDevice), and ",parameters=FILE" for a device with other
/// parameters.
class PolhemDriver final : public DeviceDriver {
public:
    explicit PolhemDriver(PolhemOptions options = PolhemOptions::standard());

    std::string_view scheme() const noexcept override { return "polhem"; }
    std::vector<FoundDevice> find() override;
    Status checkAddress(std::string_view address) const override;
    Result<std::unique_ptr<HapticDevice>> open(std::string_view address) override;

private:
    PolhemOptions options_;
};

} // namespace marsview
