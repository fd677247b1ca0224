#include "haptics/drivers/mouse/mouse_driver.h"

#include <fmt/format.h>
#include <utility>

namespace marsview {
namespace {

constexpr const char* kNoWindow = "the mouse device needs the program's window, which is not open";

} // namespace

MouseDriver::MouseDriver(std::shared_ptr<MouseLink> link)
    : link_(std::move(link))
{}

std::vector<FoundDevice> MouseDriver::find()
{
    return {{"mouse:", "Mouse", link_ == nullptr ? kNoWindow : ""}};
}

Result<std::unique_ptr<HapticDevice>> MouseDriver::open(std::string_view address)
{
    const auto refused = [&](ErrorCode code, std::string_view why) {
        return Error{code, fmt::format("mouse:{}: {}", address, why)};
    };
    if (!address.empty()) {
        return refused(ErrorCode::Invalid, "this device takes no address; write mouse:");
    }
    if (link_ == nullptr) {
        return refused(ErrorCode::NotFound, kNoWindow);
    }
    std::unique_ptr<MouseDevice> device = MouseDevice::open(link_);
    if (device == nullptr) {
        return refused(ErrorCode::Unreadable, "is already in use; close it there first");
    }
    return std::unique_ptr<HapticDevice>(std::move(device));
}

} // namespace marsview
