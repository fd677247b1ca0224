#include "haptics/drivers/openhaptics/openhaptics_device.h"

#include "core/base/check.h"
#include "haptics/device/capability_check.h"
#include "haptics/device/checked_device.h"
#include "haptics/drivers/openhaptics/openhaptics_frame.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <thread>
#include <utility>

namespace marsview {
namespace {

using Clock = std::chrono::steady_clock;

// Limits for devices that report none: those of the weakest, the Omni.
constexpr double kForceNPeak = 3.3;
constexpr double kForceNContinuous = 0.88;
constexpr double kStiffnessNPerMeterMax = 1000.0;

constexpr unsigned kFramesBetweenCalibrationChecks = 200;
// After a force error the force stays off for half a second.
constexpr unsigned kFramesOfRest = 500;
constexpr std::uint8_t kButtons = 2;

struct ForceNumbers {
    double stiffness_n_per_mm = 0.0;
    double force_n = 0.0;
    double continuous_n = 0.0;

    // From the Omni (about 1 N/mm, 3.3 N) to the Premium 3.0 (22 N), with a margin.
    bool isSane() const
    {
        const auto is_within = [](double value, double low, double high) {
            return value >= low && value <= high;
        };
        return is_within(stiffness_n_per_mm, 0.05, 20.0) && is_within(force_n, 0.5, 60.0) &&
               is_within(continuous_n, 0.05, force_n);
    }
};

} // namespace

OpenHapticsDevice::OpenHapticsDevice(Options options, hd::Handle handle)
    : api_(std::move(options.api))
    , lock_(std::move(options.lock))
    , handle_(handle)
{}

Result<std::unique_ptr<HapticDevice>> OpenHapticsDevice::open(Options options)
{
    const std::string uri = options.uri;
    const bool is_at_home = options.is_at_home;
    const std::shared_ptr<OpenHapticsApi> api = options.api;
    api->takeErrors();
    const hd::Handle handle =
        api->init_device(options.name.empty() ? nullptr : options.name.c_str());
    const unsigned int error = api->takeErrors();
    if (handle == hd::kInvalidHandle || (error & hd::kErrorGroup) == hd::kDeviceErrors ||
        error == hd::kInvalidLicense) {
        if (handle != hd::kInvalidHandle) {
            api->disable_device(handle);
            api->takeErrors();
        }
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: {}", uri, openHapticsErrorText(error))};
    }
    std::unique_ptr<OpenHapticsDevice> device(new OpenHapticsDevice(std::move(options), handle));
    device->describe();
    if (const auto fault = impossibilityOf(device->capabilities_)) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: {}, which is implausible; run the vendor's setup program "
                                 "(Touch_Setup) again",
                                 uri, *fault)};
    }
    if (is_at_home) {
        if (!device->capabilities_.can_set_home) {
            return Error{ErrorCode::Unsupported,
                         fmt::format("{}: has no encoders to reset in a home position; open it "
                                     "without \",home\": it {}",
                                     uri,
                                     device->calibrationAdvice(hd::kCalibrationNeedsManualInput))};
        }
        if (const unsigned int reset_error = device->resetEncoders(); reset_error != hd::kSuccess) {
            return Error{ErrorCode::Unreadable,
                         fmt::format("{}: its encoders were not reset: it {}", uri,
                                     openHapticsErrorText(reset_error))};
        }
    }
    return std::unique_ptr<HapticDevice>(std::make_unique<CheckedDevice>(std::move(device)));
}

OpenHapticsDevice::~OpenHapticsDevice()
{
    stopClock();
    api_->make_current_device(handle_);
    api_->disable(hd::kForceOutput);
    api_->disable_device(handle_);
    api_->takeErrors();
}

// Returns whether the library supports the parameter.
template <typename T, typename Get>
bool OpenHapticsDevice::get(Get getter, hd::Enum what, T* values) const
{
    getter(what, values);
    return api_->takeErrors() == hd::kSuccess;
}

void OpenHapticsDevice::describe()
{
    api_->make_current_device(handle_);
    const char* vendor = api_->get_string(hd::kDeviceVendor);
    const char* model = api_->get_string(hd::kDeviceModelType);
    capabilities_.name = fmt::format("{} {}", vendor != nullptr ? vendor : "3D Systems",
                                     model != nullptr ? model : "haptic device");
    api_->takeErrors();

    std::array<double, 6> box{};
    if (!get(api_->get_doublev, hd::kUsableWorkspaceDimensions, box.data()) || box[3] <= box[0]) {
        get(api_->get_doublev, hd::kMaxWorkspaceDimensions, box.data());
    }
    capabilities_.workspace = boxFromOpenHaptics(box);
    describeForces();

    int number = 0;
    capabilities_.rate_hz =
        get(api_->get_integerv, hd::kUpdateRate, &number) && number > 0 ? number : 1000;
    capabilities_.axes_in = get(api_->get_integerv, hd::kInputDof, &number) && number == 3 ? 3 : 6;
    capabilities_.axes_out = 3;
    capabilities_.buttons = kButtons;
    capabilities_.owns_clock = true;
    describeCalibration();
    // Devices without an inkwell also report a state for its switch.
    const bool has_inkwell = (calibration_styles_ & hd::kCalibrationStyleInkwell) != 0;
    unsigned char switched = 0;
    capabilities_.has_presence =
        has_inkwell && get(api_->get_booleanv, hd::kCurrentInkwellSwitch, &switched);

    api_->enable(hd::kForceOutput);
    api_->enable(hd::kMaxForceClamping);
    api_->takeErrors();
}

// The vendor's order: auto before inkwell before encoder reset. An encoder reset takes the current
// pose as the neutral one, whatever it is, so only a person's statement starts it, before the
// scheduler runs.
void OpenHapticsDevice::describeCalibration()
{
    int styles = 0;
    calibration_styles_ = get(api_->get_integerv, hd::kCalibrationStyle, &styles) ? styles : 0;
    for (const int style : {hd::kCalibrationStyleAuto, hd::kCalibrationStyleInkwell}) {
        if (calibration_style_ == 0 && (calibration_styles_ & style) != 0) {
            calibration_style_ = static_cast<hd::Enum>(style);
        }
    }
    capabilities_.can_set_home =
        calibration_style_ == 0 && (calibration_styles_ & hd::kCalibrationStyleEncoderReset) != 0;
}

unsigned int OpenHapticsDevice::resetEncoders()
{
    api_->make_current_device(handle_);
    api_->update_calibration(hd::kCalibrationStyleEncoderReset);
    return api_->takeErrors();
}

// The headers of some versions number these parameters one higher: the numbering that gives
// plausible values is the library's.
void OpenHapticsDevice::describeForces()
{
    capabilities_.stiffness_n_per_m_max = kStiffnessNPerMeterMax;
    capabilities_.force_n_peak = kForceNPeak;
    capabilities_.force_n_continuous = kForceNContinuous;
    for (const unsigned int shift : {0U, 1U}) {
        ForceNumbers numbers;
        if (get(api_->get_doublev, hd::kNominalMaxStiffness + shift, &numbers.stiffness_n_per_mm) &&
            get(api_->get_doublev, hd::kNominalMaxForce + shift, &numbers.force_n) &&
            get(api_->get_doublev, hd::kNominalMaxContinuousForce + shift, &numbers.continuous_n) &&
            numbers.isSane()) {
            capabilities_.stiffness_n_per_m_max = numbers.stiffness_n_per_mm * 1000.0;
            capabilities_.force_n_peak = numbers.force_n;
            capabilities_.force_n_continuous = numbers.continuous_n;
            return;
        }
    }
}

DeviceStatus OpenHapticsDevice::read(DeviceSample& sample) noexcept
{
    // The vendor's library accepts forces only within a frame, on its own thread.
    if (frame_thread_ != std::this_thread::get_id()) {
        return status_ == DeviceStatus::Lost ? DeviceStatus::Lost : DeviceStatus::Unready;
    }
    if (status_ == DeviceStatus::Fine) {
        sample = sample_;
    }
    return status_;
}

DeviceStatus OpenHapticsDevice::write(const Vec3& force_n) noexcept
{
    if (frame_thread_ != std::this_thread::get_id() || status_ != DeviceStatus::Fine) {
        return status_ == DeviceStatus::Lost ? DeviceStatus::Lost : DeviceStatus::Unready;
    }
    const std::array<double, 3> force = forceToOpenHaptics(force_n);
    api_->set_doublev(hd::kCurrentForce, force.data());
    return DeviceStatus::Fine;
}

bool OpenHapticsDevice::startClock(ClockTick tick, void* self) noexcept
{
    MARSVIEW_CHECK(!is_scheduled_);
    tick_ = tick;
    tick_self_ = self;
    is_stopping_.store(false, std::memory_order_relaxed);
    scheduled_ = api_->schedule_asynchronous(
        [](void* device) { return static_cast<OpenHapticsDevice*>(device)->frame(); }, this,
        hd::kPriorityMax);
    unsigned int error = api_->takeErrors();
    if (error == hd::kSuccess) {
        error = api_->addSchedulerUser();
        if (error == hd::kSuccess) {
            is_scheduled_ = true;
            return true;
        }
        api_->unschedule(scheduled_);
        api_->takeErrors();
    }
    error_.store(error, std::memory_order_relaxed);
    return false;
}

void OpenHapticsDevice::stopClock() noexcept
{
    if (!is_scheduled_) {
        return;
    }
    is_stopping_.store(true);
    api_->unschedule(scheduled_);
    api_->removeSchedulerUser();
    // These calls may return while a frame is still running.
    while (is_inside_.load()) {
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    is_scheduled_ = false;
}

// One frame of the vendor's scheduler.
unsigned int OpenHapticsDevice::frame() noexcept
{
    is_inside_.store(true);
    if (is_stopping_.load()) {
        is_inside_.store(false);
        return hd::kCallbackDone;
    }
    const Clock::time_point now = Clock::now(); // before calls that may wait for the bus
    api_->begin_frame(handle_);
    beginFrame(now);
    frame_thread_ = std::this_thread::get_id();
    tick_(tick_self_, now);
    frame_thread_ = std::thread::id();
    api_->end_frame(handle_);
    take(api_->takeErrors());
    ++frames_;
    is_inside_.store(false);
    return hd::kCallbackContinue;
}

void OpenHapticsDevice::beginFrame(Clock::time_point now) noexcept
{
    // Zero unless the tick sets a force: forces of the previous frame do not stay on.
    constexpr std::array<double, 3> kNoForce{};
    api_->set_doublev(hd::kCurrentForce, kNoForce.data());
    if (!is_calibrated_ || frames_ % kFramesBetweenCalibrationChecks == 0) {
        checkCalibration();
    }
    std::array<double, 3> position{};
    std::array<double, 3> gimbal{};
    std::array<double, 16> transform{};
    int buttons = 0;
    unsigned char is_out_of_inkwell = 1; // the switch is 0 with the stylus in it
    api_->get_doublev(hd::kCurrentPosition, position.data());
    api_->get_integerv(hd::kCurrentButtons, &buttons);
    if (capabilities_.axes_in > 3) {
        api_->get_doublev(hd::kCurrentGimbalAngles, gimbal.data());
        api_->get_doublev(hd::kCurrentTransform, transform.data());
    }
    if (capabilities_.has_presence) {
        api_->get_booleanv(hd::kCurrentInkwellSwitch, &is_out_of_inkwell);
    }
    sample_.position = fromOpenHaptics(position);
    sample_.twist_rad = twistFromOpenHaptics(gimbal[2]);
    sample_.orientation = orientationFromOpenHaptics(transform);
    sample_.buttons = static_cast<std::uint32_t>(buttons);
    sample_.is_held = is_out_of_inkwell != 0;
    sample_.time = now;
    take(api_->takeErrors());
    updateStatus();
}

void OpenHapticsDevice::checkCalibration() noexcept
{
    const hd::Enum state = api_->check_calibration();
    calibration_.store(state, std::memory_order_relaxed);
    is_calibrated_ = state == hd::kCalibrationOk;
    if (state == hd::kCalibrationNeedsUpdate && calibration_style_ != 0) {
        api_->update_calibration(calibration_style_);
    }
}

void OpenHapticsDevice::take(unsigned int error) noexcept
{
    const unsigned int group = error & hd::kErrorGroup;
    if (status_ == DeviceStatus::Lost ||
        (group != hd::kDeviceErrors && group != hd::kForceErrors)) {
        return;
    }
    error_.store(error, std::memory_order_relaxed);
    if (group == hd::kDeviceErrors) {
        status_ = DeviceStatus::Lost;
    } else {
        frames_of_rest_ = kFramesOfRest;
    }
}

void OpenHapticsDevice::updateStatus() noexcept
{
    if (status_ == DeviceStatus::Lost) {
        return;
    }
    if (frames_of_rest_ > 0) {
        status_ = DeviceStatus::Unready;
        if (--frames_of_rest_ == 0) {
            api_->enable(hd::kForceOutput); // the library turns it off after such an error
            error_.store(hd::kSuccess, std::memory_order_relaxed);
        }
        return;
    }
    status_ = is_calibrated_ ? DeviceStatus::Fine : DeviceStatus::Unready;
}

std::string OpenHapticsDevice::trouble() const
{
    if (const unsigned int error = error_.load(std::memory_order_relaxed); error != hd::kSuccess) {
        return openHapticsErrorText(error);
    }
    const hd::Enum state = calibration_.load(std::memory_order_relaxed);
    return state == hd::kCalibrationOk ? std::string() : calibrationAdvice(state);
}

// The table in README.md says which device has which calibration.
std::string OpenHapticsDevice::calibrationAdvice(hd::Enum state) const
{
    const bool has_inkwell = (calibration_styles_ & hd::kCalibrationStyleInkwell) != 0;
    if (calibration_style_ == hd::kCalibrationStyleAuto) {
        return has_inkwell ? "is not calibrated yet; move the stylus through its workspace, or put "
                             "it into the inkwell"
                           : "is not calibrated yet; move the stylus through its workspace";
    }
    if (has_inkwell) {
        return state == hd::kCalibrationNeedsUpdate
                   ? "is being calibrated; leave the stylus in the inkwell for a moment"
                   : "is not calibrated; put the stylus into the inkwell";
    }
    if (capabilities_.can_set_home) {
        return "is not calibrated; hold the stylus in its neutral position, with all links at "
               "right "
               "angles, and press Set Home Position, or open it there with \",home\" after its "
               "address";
    }
    return "is not calibrated; calibrate it with the vendor's setup program (Touch_Setup)";
}

} // namespace marsview
