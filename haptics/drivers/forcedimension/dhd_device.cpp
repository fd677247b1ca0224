#include "haptics/drivers/forcedimension/dhd_device.h"

#include "haptics/device/capability_check.h"
#include "haptics/device/checked_device.h"
#include "haptics/drivers/forcedimension/dhd_frame.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <utility>

namespace marsview {
namespace {

constexpr std::chrono::milliseconds kPeriod{1};
constexpr std::chrono::milliseconds kWatchdog{20};
// A cable that is out for this long is not a passing fault of the bus.
constexpr std::chrono::milliseconds kSilenceMax{500};
constexpr unsigned kRoundsBetweenStatus = 20;
constexpr int kTriesOfReading = 4;
constexpr int kButtons = 2;
// Below the loop's priority, above all other threads; the default priority if that is not
// permitted.
constexpr int kPriority = 70;

} // namespace

DhdDevice::DhdDevice(Options options, dhd::Id id)
    : api_(std::move(options.api))
    , lock_(std::move(options.lock))
    , id_(id)
{}

Result<std::unique_ptr<HapticDevice>> DhdDevice::open(Options options)
{
    const std::string uri = options.uri;
    const std::shared_ptr<const DhdApi> api = options.api;
    if (options.number >= api->get_device_count()) {
        return Error{ErrorCode::NotFound,
                     fmt::format("{}: is not connected; check its power and its cable", uri)};
    }
    const int id = api->open_id(static_cast<dhd::Id>(options.number));
    if (id < 0) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: could not be opened ({}); check its power and its cable, and "
                                 "whether another program uses it",
                                 uri, api->lastError())};
    }
    std::unique_ptr<DhdDevice> device(new DhdDevice(std::move(options), static_cast<dhd::Id>(id)));
    device->describe();
    if (const auto fault = impossibilityOf(device->capabilities_)) {
        return Error{ErrorCode::Invalid, fmt::format("{}: {}, which is implausible", uri, *fault)};
    }
    api->enable_force(1, device->id_);
    DhdDevice& running = *device;
    running.heard_ = Clock::now();
    running.thread_ = std::thread([&running] { running.run(); });
    sched_param parameters{};
    parameters.sched_priority = kPriority;
    pthread_setschedparam(running.thread_.native_handle(), SCHED_FIFO, &parameters);
    return std::unique_ptr<HapticDevice>(std::make_unique<CheckedDevice>(std::move(device)));
}

DhdDevice::~DhdDevice()
{
    is_stopping_.store(true);
    if (thread_.joinable()) {
        thread_.join();
    }
    api_->set_force(0.0, 0.0, 0.0, id_);
    api_->stop(id_);
    api_->close(id_);
}

void DhdDevice::describe()
{
    const int type = api_->get_system_type(id_);
    model_ = &dhdModel(type);
    const char* name = api_->get_system_name != nullptr ? api_->get_system_name(id_) : nullptr;
    capabilities_.name = name != nullptr && *name != '\0'
                             ? fmt::format("{} ({})", model_->name, name)
                             : std::string(model_->name);
    const double half_m = model_->half_side_m;
    capabilities_.workspace = {{-half_m, -half_m, -half_m}, {half_m, half_m, half_m}};
    capabilities_.force_n_peak = model_->force_n_peak;
    if (api_->get_max_force != nullptr) {
        const double limit_n = api_->get_max_force(id_); // negative: none
        capabilities_.force_n_peak =
            limit_n > 0.0 ? std::min(limit_n, model_->force_n_peak) : model_->force_n_peak;
    }
    capabilities_.stiffness_n_per_m_max = model_->stiffness_n_per_m_max;
    capabilities_.rate_hz = 1000.0;
    capabilities_.axes_in = api_->has_wrist(id_) ? 6 : 3;
    capabilities_.axes_out = 3;
    capabilities_.buttons = kButtons;
    if (api_->has_active_gripper != nullptr && api_->emulate_button != nullptr &&
        api_->has_active_gripper(id_)) {
        api_->emulate_button(1, id_);
    }
}

DeviceStatus DhdDevice::read(DeviceSample& sample) noexcept
{
    const State state = state_.load(std::memory_order_acquire);
    if (state != State::Fine) {
        return state == State::Lost ? DeviceStatus::Lost : DeviceStatus::Unready;
    }
    // The other thread writes once per millisecond: a reader cannot meet the writer repeatedly.
    for (int i = 0; i < kTriesOfReading; ++i) {
        if (const auto newest = sample_.tryRead()) {
            last_sample_ = *newest;
            break;
        }
    }
    sample = last_sample_;
    return DeviceStatus::Fine;
}

DeviceStatus DhdDevice::write(const Vec3& force_n) noexcept
{
    const State state = state_.load(std::memory_order_acquire);
    if (state == State::Lost) {
        return DeviceStatus::Lost;
    }
    wanted_.write({force_n, Clock::now()});
    return state == State::Fine ? DeviceStatus::Fine : DeviceStatus::Unready;
}

std::string DhdDevice::trouble() const
{
    switch (state_.load(std::memory_order_relaxed)) {
    case State::Fine:
        return {};
    case State::Silent:
        return "does not answer; check its power and its cable";
    case State::Uncalibrated:
        return std::string(model_->calibration_advice);
    case State::ForcesOff:
        return "has its forces off: it moved too fast, or its force button was pressed; press the "
               "force button";
    case State::Lost:
        return "was unplugged or switched off; plug it in and connect again";
    }
    return {};
}

void DhdDevice::run() noexcept
{
    Clock::time_point next = Clock::now();
    while (!is_stopping_.load(std::memory_order_relaxed)) {
        const Clock::time_point now = Clock::now();
        if (exchange()) {
            heard_ = now;
        } else if (now - heard_ > kSilenceMax) {
            state_.store(State::Lost, std::memory_order_release);
            return;
        } else {
            state_.store(State::Silent, std::memory_order_release);
            rounds_ = 0; // the status is read first
        }
        next = std::max(next + kPeriod, now); // never makes up for lost rounds
        std::this_thread::sleep_until(next);
    }
}

// One round: status, sample, force; false if the device did not answer.
bool DhdDevice::exchange() noexcept
{
    if (rounds_++ % kRoundsBetweenStatus == 0 && !readStatus()) {
        return false;
    }
    const std::optional<DeviceSample> sample = readSample();
    if (!sample) {
        return false;
    }
    sample_.write(*sample);
    state_.store(newest_state_, std::memory_order_release);
    const Wanted wanted = wanted_.read();
    const bool is_wanted = newest_state_ == State::Fine && Clock::now() - wanted.time < kWatchdog;
    return setForce(is_wanted ? wanted.force_n : Vec3{});
}

bool DhdDevice::readStatus() noexcept
{
    dhd::Status status{};
    if (api_->get_status(status.data(), id_) < 0) {
        return false;
    }
    const bool is_uncalibrated = status[dhd::kStatusReset] != 0;
    if (std::exchange(was_uncalibrated_, is_uncalibrated) && !is_uncalibrated) {
        api_->enable_force(1, id_);
        rounds_ = 0; // whether that worked is known in the next round
    }
    newest_state_ = is_uncalibrated                  ? State::Uncalibrated
                    : status[dhd::kStatusForce] == 0 ? State::ForcesOff
                                                     : State::Fine;
    return true;
}

std::optional<DeviceSample> DhdDevice::readSample() noexcept
{
    DeviceSample sample;
    sample.time = Clock::now(); // before calls that wait for the bus
    std::array<double, 3> position{};
    auto& [x, y, z] = position;
    if (capabilities_.axes_in > 3) {
        double frame[3][3] = {}; // NOLINT(modernize-avoid-c-arrays): the library's
        if (api_->get_position_and_frame(&x, &y, &z, frame, id_) < 0) {
            return std::nullopt;
        }
        sample.orientation = orientationFromDhd({{{frame[0][0], frame[0][1], frame[0][2]},
                                                  {frame[1][0], frame[1][1], frame[1][2]},
                                                  {frame[2][0], frame[2][1], frame[2][2]}}});
        sample.twist_rad = twistOf(sample.orientation);
    } else if (api_->get_position(&x, &y, &z, id_) < 0) {
        return std::nullopt;
    }
    sample.position = fromDhd(position);
    for (int i = 0; i < kButtons; ++i) {
        if (api_->get_button(i, id_) > 0) {
            sample.buttons |= 1U << static_cast<unsigned>(i);
        }
    }
    return sample;
}

bool DhdDevice::setForce(const Vec3& force_n) noexcept
{
    const std::array<double, 3> force = forceToDhd(force_n);
    return api_->set_force(force[0], force[1], force[2], id_) >= 0;
}

} // namespace marsview
