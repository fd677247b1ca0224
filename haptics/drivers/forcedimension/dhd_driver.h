// Force Dimension devices and the Novint Falcon through the vendor's library.
#pragma once

#include "haptics/device/device_driver.h"
#include "haptics/drivers/forcedimension/dhd_api.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

struct DhdOptions {
    std::vector<std::string> libraries; // files or names of libdhd, tried in this order
    std::filesystem::path lock_folder;
    std::chrono::milliseconds patience{10'000}; // for counting and for opening devices

    /// $MARSVIEW_FORCEDIMENSION_LIBRARY before the usual library names.
    static DhdOptions standard();
};

/// "forcedimension:" opens the first device, "forcedimension:1" the second: the library numbers the
/// devices that are connected.
class DhdDriver final : public DeviceDriver {
public:
    explicit DhdDriver(DhdOptions options = DhdOptions::standard());

    std::string_view scheme() const noexcept override { return "forcedimension"; }
    /// The connected devices; which models they are is known only when they are opened.
    std::vector<FoundDevice> find() override;
    Status checkAddress(std::string_view address) const override;
    Result<std::unique_ptr<HapticDevice>> open(std::string_view address) override;

private:
    Result<std::shared_ptr<const DhdApi>> load();

    DhdOptions options_;
    std::shared_ptr<const DhdApi> api_;
    std::string complaint_; // of the dynamic loader, if no library could be loaded
    bool has_hung_ = false;
};

} // namespace marsview
