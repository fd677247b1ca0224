// WoodenHaptics and Polhem arms over USB HID.
#pragma once

#include "haptics/device/device_driver.h"
#include "haptics/drivers/hid_api.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

struct PolhemOptions {
    const HidApi* api = &systemHidApi();
    /// Files of parameters (polhem_parameters.h), of which the first that exists counts.
    std::vector<std::filesystem::path> parameter_files;
    std::filesystem::path lock_folder;

    /// $XDG_CONFIG_HOME/marsview/devices/polhem.json, else ~/.config/…, else the bundled one.
    static PolhemOptions standard();
};

/// What may be remembered of a URI: without ",home", which somebody says who stands beside the arm,
/// and which is not true of another day. Of other drivers' devices all of it.
std::string lastingPolhemUri(std::string_view uri);

/// "polhem:serial=4711", which finds the arm under whatever path it has that day; the same as
/// "polhem:usb=1234:0006" for one whose board has no number, the only one of its kind. Invalid,
/// with the paths to choose from, where several arms share the name. "polhem:/dev/hidraw2", or
/// "polhem:" for the first one. Then ",home" where the arm is in its rest position and shall be
/// calibrated there without its board's button (PolhemDevice), and ",parameters=FILE" for one that
/// differs.
class PolhemDriver final : public DeviceDriver {
public:
    explicit PolhemDriver(PolhemOptions options = PolhemOptions::standard());

    std::string_view scheme() const noexcept override { return "polhem"; }
    std::vector<FoundDevice> find() override;
    Result<std::unique_ptr<HapticDevice>> open(std::string_view address) override;

private:
    PolhemOptions options_;
};

} // namespace marsview
