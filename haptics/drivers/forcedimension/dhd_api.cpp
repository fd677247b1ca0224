#include "haptics/drivers/forcedimension/dhd_api.h"

#include "haptics/drivers/support/vendor_library.h"

#include <fmt/format.h>
#include <optional>

namespace marsview {

// libdrd contains the functions of libdhd.
std::vector<std::string> DhdApi::defaultNames()
{
    return {"libdhd.so.3", "libdhd.so", "libdrd.so.3", "libdrd.so"};
}

Result<std::shared_ptr<const DhdApi>> DhdApi::load(const std::vector<std::string>& names,
                                                   std::string& complaint)
{
    std::optional<VendorLibrary> library = VendorLibrary::load(names, complaint);
    if (!library) {
        return Error{ErrorCode::NotFound,
                     "the Force Dimension SDK is not installed; install it, or set "
                     "MARSVIEW_FORCEDIMENSION_LIBRARY to its libdhd"};
    }
    const auto api = std::make_shared<DhdApi>();
    library->find(api->get_device_count, "dhdGetDeviceCount");
    library->find(api->open_id, "dhdOpenID");
    library->find(api->close, "dhdClose");
    library->find(api->stop, "dhdStop");
    library->find(api->get_system_type, "dhdGetSystemType");
    library->find(api->get_status, "dhdGetStatus");
    library->find(api->has_wrist, "dhdHasWrist");
    library->find(api->enable_force, "dhdEnableForce");
    library->find(api->get_position, "dhdGetPosition");
    library->find(api->get_position_and_frame, "dhdGetPositionAndOrientationFrame");
    library->find(api->get_button, "dhdGetButton");
    library->find(api->set_force, "dhdSetForce");
    library->find(api->error_text, "dhdErrorGetLastStr");
    library->findOptional(api->get_system_name, "dhdGetSystemName");
    library->findOptional(api->get_max_force, "dhdGetMaxForce");
    library->findOptional(api->has_active_gripper, "dhdHasActiveGripper");
    library->findOptional(api->emulate_button, "dhdEmulateButton");
    if (!library->missing().empty()) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("the Force Dimension library lacks the function {}; install a "
                                 "newer version of its SDK",
                                 library->missing())};
    }
    return std::shared_ptr<const DhdApi>(api);
}

std::string DhdApi::lastError() const
{
    const char* text = error_text();
    return text != nullptr && *text != '\0' ? text : "unknown error";
}

} // namespace marsview
