// The parts used of the vendor's library for PHANTOM and Touch devices, libHD of OpenHaptics. Its
// license forbids redistribution, so it is loaded at run time and its interface is declared again
// here.
//
// Names, types and numbers are those of the HDAPI of OpenHaptics 3.0 to 3.4 for Linux.
#pragma once

#include "core/base/result.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace marsview {

namespace hd {

using Handle = unsigned int; // HHD
using Enum = unsigned int;   // HDenum
using SchedulerHandle = unsigned long;

struct ErrorInfo {
    unsigned int code;
    int internal_code;
    Handle device;
};
static_assert(sizeof(ErrorInfo) == 12);

constexpr Handle kInvalidHandle = 0xFFFFFFFF;

constexpr unsigned int kSuccess = 0x0000;
constexpr unsigned int kForceErrors = 0x0200; // to 0x02FF
constexpr unsigned int kWarmMotors = 0x0200;
constexpr unsigned int kExceededMaxVelocity = 0x0203;
constexpr unsigned int kDeviceErrors = 0x0300; // to 0x03FF
constexpr unsigned int kDeviceAlreadyInitiated = 0x0301;
constexpr unsigned int kCommError = 0x0302;
constexpr unsigned int kCommConfigError = 0x0303;
constexpr unsigned int kInvalidLicense = 0x0600;
constexpr unsigned int kErrorGroup = 0xFF00;

constexpr Enum kCurrentButtons = 0x2000;
constexpr Enum kCurrentInkwellSwitch = 0x2002;
constexpr Enum kCurrentPosition = 0x2050;     // 3 doubles, mm
constexpr Enum kCurrentTransform = 0x2052;    // 16 doubles, column-major
constexpr Enum kCurrentGimbalAngles = 0x2150; // 3 doubles, rad; the third is the stylus twist
constexpr Enum kDeviceModelType = 0x2501;
constexpr Enum kDeviceVendor = 0x2503;
constexpr Enum kMaxWorkspaceDimensions = 0x2550;    // 6 doubles, mm: minimum corner, maximum corner
constexpr Enum kUsableWorkspaceDimensions = 0x2551; // likewise
constexpr Enum kInputDof = 0x2553;
constexpr Enum kCalibrationStyle = 0x2555;
constexpr Enum kUpdateRate = 0x2600;
constexpr Enum kNominalMaxStiffness = 0x2602; // N/mm; one higher in some headers, as the next two
constexpr Enum kNominalMaxForce = 0x2603;
constexpr Enum kNominalMaxContinuousForce = 0x2604;
constexpr Enum kCurrentForce = 0x2700; // 3 doubles, N
constexpr Enum kForceOutput = 0x4000;
constexpr Enum kMaxForceClamping = 0x4001;

constexpr Enum kCalibrationOk = 0x5000;
constexpr Enum kCalibrationNeedsUpdate = 0x5001;
constexpr Enum kCalibrationNeedsManualInput = 0x5002;
constexpr int kCalibrationStyleEncoderReset = 1 << 0;
constexpr int kCalibrationStyleAuto = 1 << 1;
constexpr int kCalibrationStyleInkwell = 1 << 2;

constexpr unsigned short kPriorityMax = 0xFFFF;
constexpr unsigned int kCallbackDone = 0;
constexpr unsigned int kCallbackContinue = 1;

using Callback = unsigned int (*)(void* user);

} // namespace hd

/// The loaded library. Its functions are the vendor's; those for a frame may only be called on the
/// scheduler's thread.
class OpenHapticsApi {
public:
    /// The usual names of the installed library, the newest first.
    static std::vector<std::string> defaultNames();

    /// Loads the first of these files or names that can be loaded. NotFound if none can,
    /// Unsupported if a library lacks a function. `complaint` receives the dynamic loader's message
    /// if no library could be loaded.
    static Result<std::shared_ptr<OpenHapticsApi>> load(const std::vector<std::string>& names,
                                                        std::string& complaint);

    hd::Handle (*init_device)(const char* name) = nullptr;
    void (*disable_device)(hd::Handle device) = nullptr;
    void (*make_current_device)(hd::Handle device) = nullptr;
    void (*begin_frame)(hd::Handle device) = nullptr;
    void (*end_frame)(hd::Handle device) = nullptr;
    hd::ErrorInfo (*get_error)() = nullptr;
    void (*enable)(hd::Enum what) = nullptr;
    void (*disable)(hd::Enum what) = nullptr;
    void (*get_booleanv)(hd::Enum what, unsigned char* values) = nullptr;
    void (*get_integerv)(hd::Enum what, int* values) = nullptr;
    void (*get_doublev)(hd::Enum what, double* values) = nullptr;
    const char* (*get_string)(hd::Enum what) = nullptr;
    void (*set_doublev)(hd::Enum what, const double* values) = nullptr;
    hd::Enum (*check_calibration)() = nullptr;
    void (*update_calibration)(hd::Enum style) = nullptr;
    hd::SchedulerHandle (*schedule_asynchronous)(hd::Callback callback,
                                                 void* user,
                                                 unsigned short priority) = nullptr;
    void (*unschedule)(hd::SchedulerHandle handle) = nullptr;

    /// All devices share one scheduler: it runs from the first start to the last stop. Returns the
    /// error code of the start, or kSuccess. Any thread.
    unsigned int addSchedulerUser();
    void removeSchedulerUser();

    /// Removes all errors from the library's stack; returns the most serious one, or kSuccess.
    unsigned int takeErrors() const noexcept;

private:
    void (*start_scheduler_)() = nullptr;
    void (*stop_scheduler_)() = nullptr;
    void (*set_scheduler_rate_)(unsigned long hz) = nullptr;

    std::mutex mutex_;
    int scheduler_users_ = 0;
};

/// What an error code means and what to do about it, phrased to follow the device's name.
std::string openHapticsErrorText(unsigned int code);

} // namespace marsview
