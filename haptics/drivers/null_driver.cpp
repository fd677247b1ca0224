#include "haptics/drivers/null_driver.h"

#include "haptics/drivers/support/uri_parameters.h"

#include <fmt/format.h>

namespace marsview {
namespace {

class NullDevice final : public HapticDevice {
public:
    NullDevice()
    {
        capabilities_.name = "No device";
        capabilities_.workspace = {{-0.08, -0.06, -0.06}, {0.08, 0.06, 0.06}};
        capabilities_.buttons = 0;
        capabilities_.axes_out = 0;
    }
    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override
    {
        sample = {.time = std::chrono::steady_clock::now()};
        return DeviceStatus::Fine;
    }
    DeviceStatus write(const Vec3& /*force_n*/) noexcept override { return DeviceStatus::Fine; }

private:
    DeviceCapabilities capabilities_;
};

class NullDriver final : public DeviceDriver {
public:
    std::string_view scheme() const noexcept override { return "null"; }
    std::vector<FoundDevice> find() override { return {{"null:", "No device", ""}}; }
    Status checkAddress(std::string_view address) const override
    {
        return readUriParameters(fmt::format("null:{}", address), address, {});
    }
    Result<std::unique_ptr<HapticDevice>> open(std::string_view address) override
    {
        const Status checked = checkAddress(address);
        if (!checked) {
            return checked.error();
        }
        return std::unique_ptr<HapticDevice>(new NullDevice);
    }
};

} // namespace

std::unique_ptr<DeviceDriver> makeNullDriver()
{
    return std::make_unique<NullDriver>();
}

} // namespace marsview
