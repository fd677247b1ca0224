#include "haptics/drivers/openhaptics/openhaptics_api.h"

#include "haptics/drivers/support/vendor_library.h"

#include <fmt/format.h>
#include <optional>

namespace marsview {
namespace {

constexpr int kErrorsMax = 16; // more than its stack can hold; bounds the loop
constexpr unsigned long kRateHz = 1000;

} // namespace

std::vector<std::string> OpenHapticsApi::defaultNames()
{
    return {"libHD.so.3.4", "libHD.so.3.0", "libHD.so.3", "libHD.so"};
}

Result<std::shared_ptr<OpenHapticsApi>> OpenHapticsApi::load(const std::vector<std::string>& names,
                                                             std::string& complaint)
{
    std::optional<VendorLibrary> library = VendorLibrary::load(names, complaint);
    if (!library) {
        return Error{ErrorCode::NotFound,
                     "OpenHaptics is not installed; install OpenHaptics and the device's driver "
                     "from 3D Systems"};
    }
    const auto api = std::make_shared<OpenHapticsApi>();
    const auto find = [&](auto& function, const char* name) { library->find(function, name); };
    find(api->init_device, "hdInitDevice");
    find(api->disable_device, "hdDisableDevice");
    find(api->make_current_device, "hdMakeCurrentDevice");
    find(api->begin_frame, "hdBeginFrame");
    find(api->end_frame, "hdEndFrame");
    find(api->get_error, "hdGetError");
    find(api->enable, "hdEnable");
    find(api->disable, "hdDisable");
    find(api->get_booleanv, "hdGetBooleanv");
    find(api->get_integerv, "hdGetIntegerv");
    find(api->get_doublev, "hdGetDoublev");
    find(api->get_string, "hdGetString");
    find(api->set_doublev, "hdSetDoublev");
    find(api->check_calibration, "hdCheckCalibration");
    find(api->update_calibration, "hdUpdateCalibration");
    find(api->schedule_asynchronous, "hdScheduleAsynchronous");
    find(api->unschedule, "hdUnschedule");
    find(api->start_scheduler_, "hdStartScheduler");
    find(api->stop_scheduler_, "hdStopScheduler");
    find(api->set_scheduler_rate_, "hdSetSchedulerRate");
    if (!library->missing().empty()) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("the OpenHaptics library lacks the function {}; install "
                                 "OpenHaptics 3.0 or later",
                                 library->missing())};
    }
    return api;
}

unsigned int OpenHapticsApi::addSchedulerUser()
{
    const std::lock_guard lock(mutex_);
    if (scheduler_users_ > 0) {
        ++scheduler_users_;
        return hd::kSuccess;
    }
    set_scheduler_rate_(kRateHz);
    takeErrors(); // devices with a fixed rate refuse it and keep theirs
    start_scheduler_();
    const unsigned int error = takeErrors();
    scheduler_users_ += error == hd::kSuccess ? 1 : 0;
    return error;
}

void OpenHapticsApi::removeSchedulerUser()
{
    const std::lock_guard lock(mutex_);
    if (--scheduler_users_ == 0) {
        stop_scheduler_();
        takeErrors();
    }
}

unsigned int OpenHapticsApi::takeErrors() const noexcept
{
    unsigned int gravest = hd::kSuccess;
    for (int i = 0; i < kErrorsMax; ++i) {
        const unsigned int code = get_error().code;
        if (code == hd::kSuccess) {
            break;
        }
        // Device errors rank before force errors, and these before misuse of a function.
        const auto weight = [](unsigned int c) {
            const unsigned int group = c & hd::kErrorGroup;
            return group == hd::kDeviceErrors ? 3 : group == hd::kForceErrors ? 2 : c != 0 ? 1 : 0;
        };
        if (weight(code) > weight(gravest)) {
            gravest = code;
        }
    }
    return gravest;
}

std::string openHapticsErrorText(unsigned int code)
{
    switch (code) {
    case hd::kDeviceAlreadyInitiated:
        return "is in use by another program, or was left open by one; close that first";
    case hd::kCommError:
        return "does not answer; check its power and its cable, and whether another program uses "
               "it";
    case hd::kCommConfigError:
        return "is not set up; run the vendor's setup program (Touch_Setup) first";
    case hd::kInvalidLicense:
        return "is refused by the vendor's library; check its license";
    case hd::kWarmMotors:
        return "has overheated motors; let it cool down";
    case hd::kExceededMaxVelocity:
        return "exceeded its maximum speed";
    default:
        break;
    }
    if ((code & hd::kErrorGroup) == hd::kForceErrors) {
        return fmt::format("refused a force (error 0x{:04x} of OpenHaptics)", code);
    }
    return fmt::format(
        "failed (error 0x{:04x} of OpenHaptics); try the vendor's diagnostic "
        "program (Touch_Diagnostic)",
        code);
}

} // namespace marsview
