#include "haptics/drivers/polhem/polhem_device.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <pthread.h>
#include <sched.h>
#include <utility>

namespace marsview {
namespace {

constexpr int kReadPatienceMs = 5; // five report periods
constexpr std::chrono::milliseconds kWatchdog{20};
constexpr int kReportsAtOnceMax = 16;
constexpr int kTriesOfReading = 4;
constexpr std::size_t kReportBytesMax = 64;
// Just after power-on the encoders read zero, except for a small sag of the device.
constexpr int kUnsetCountsMax = 3;
// Below the loop's priority, above all other threads; the default priority if that is not
// permitted.
constexpr int kPriority = 70;

// Compares the three encoders that determine the position.
int farthest(const PolhemEncoders& a, const PolhemEncoders& b)
{
    int most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        most = std::max(most, std::abs(a[i] - b[i]));
    }
    return most;
}

} // namespace

PolhemDevice::PolhemDevice(Options options)
    : api_(*options.api)
    , handle_(std::move(options.handle))
    , parameters_(std::move(options.parameters))
    , lock_(std::move(options.lock))
    , layout_(options.layout)
    , homes_at_once_(options.homes_at_once)
{
    capabilities_.name = parameters_.name;
    capabilities_.workspace = polhemWorkspace(parameters_);
    capabilities_.force_n_peak = parameters_.force_n_peak;
    capabilities_.force_n_continuous = parameters_.force_n_continuous;
    capabilities_.stiffness_n_per_m_max = parameters_.stiffness_n_per_m_max;
    capabilities_.axes_in = parameters_.twist_counts_per_turn != 0.0 ? 6 : 3;
    capabilities_.axes_out = 3;
    capabilities_.can_set_home = true;
    capabilities_.buttons = 0; // the board's only button is for calibration
    thread_ = std::thread([this] { run(); });
    sched_param parameters{};
    parameters.sched_priority = kPriority;
    pthread_setschedparam(thread_.native_handle(), SCHED_FIFO, &parameters);
}

PolhemDevice::~PolhemDevice()
{
    is_stopping_.store(true);
    thread_.join();
}

DeviceStatus PolhemDevice::read(DeviceSample& sample) noexcept
{
    const State state = state_.load(std::memory_order_acquire);
    if (state != State::Fine) {
        return state == State::Lost ? DeviceStatus::Lost : DeviceStatus::Unready;
    }
    // The other thread writes a report per millisecond: a reader cannot meet the writer repeatedly.
    for (int i = 0; i < kTriesOfReading; ++i) {
        if (const auto said = said_.tryRead()) {
            last_said_ = *said;
            break;
        }
    }
    const PolhemPose pose = polhemPose(parameters_, last_said_.encoders);
    sample.position = polhemPosition(parameters_, pose);
    sample.twist_rad = polhemTwist(parameters_, last_said_.encoders);
    sample.buttons = 0;
    sample.is_held = true;
    sample.time = last_said_.time;
    return DeviceStatus::Fine;
}

DeviceStatus PolhemDevice::write(const Vec3& force_n) noexcept
{
    const State state = state_.load(std::memory_order_acquire);
    if (state == State::Lost) {
        return DeviceStatus::Lost;
    }
    wanted_.write({force_n, Clock::now()});
    return state == State::Fine ? DeviceStatus::Fine : DeviceStatus::Unready;
}

std::string PolhemDevice::trouble() const
{
    switch (state_.load(std::memory_order_relaxed)) {
    case State::Fine:
        return {};
    case State::Silent:
        return "sends no complete reports; check its power, and whether another program uses it";
    case State::Uncalibrated:
        return "is not calibrated: its encoders count from the power-on position; move it into its "
               "home "
               "position and press the button on its board, or open it there with \",home\" "
               "after its address";
    case State::NotAtRest:
        return "is not calibrated: its encoders do not read the counts of its home position; "
               "move "
               "it there and press the button on its board, or switch its power off and on there "
               "and reconnect";
    case State::NotSet:
        return "is not calibrated: its board has not set its encoders to the counts of its home "
               "position; check \"home_encoders\" in its parameters, and its firmware";
    case State::Lost:
        return "was unplugged, or its cable is loose; plug it in and connect again";
    }
    return {};
}

void PolhemDevice::run() noexcept
{
    while (!is_stopping_.load(std::memory_order_relaxed)) {
        if (!exchange()) {
            state_.store(State::Lost, std::memory_order_release);
            break;
        }
    }
    writeNow(polhemCurrentCommand(layout_, {}));
    handle_.reset();
}

// Reads a report and answers it; false if the device is gone. The boards report only in response to
// a command, so a command is sent even if no report has arrived.
bool PolhemDevice::exchange() noexcept
{
    const Clock::time_point begin = Clock::now();
    if (!readNewest()) {
        return false;
    }
    const bool is_heard = has_heard_ && begin - heard_ < kWatchdog;
    if (!is_heard) {
        if (!was_silent_) {
            was_silent_ = true;
            before_silence_ = newest_;
        }
        state_.store(State::Silent, std::memory_order_release);
        return writeNow(polhemCurrentCommand(layout_, {}));
    }
    believe();
    if (is_to_home_) {
        return home();
    }
    if (homing_ != Homing::Done) {
        state_.store(homing_ == Homing::Asked     ? State::NotSet
                     : homing_ == Homing::Refused ? State::NotAtRest
                                                  : State::Uncalibrated,
                     std::memory_order_release);
        return writeNow(polhemCurrentCommand(layout_, {}));
    }
    said_.write({corrected(newest_), heard_});
    state_.store(State::Fine, std::memory_order_release);
    const Wanted wanted = wanted_.read();
    const Vec3 force = Clock::now() - wanted.time < kWatchdog ? wanted.force_n : Vec3{};
    const PolhemPose pose = polhemPose(parameters_, corrected(newest_));
    return writeNow(polhemCurrentCommand(layout_, polhemCurrents(parameters_, pose, force)));
}

// Updates whether the encoders can be trusted, from the latest report.
void PolhemDevice::believe() noexcept
{
    if (homes_at_once_) {
        homes_at_once_ = false;
        const bool is_at_rest = farthest(newest_, {}) <= kRestCountsMax || isCloseToHome();
        is_to_home_ = is_to_home_ || is_at_rest;
        homing_ = is_at_rest ? homing_ : Homing::Refused;
    }
    if (homing_ == Homing::Asked && isCloseToHome()) {
        homing_ = Homing::Done;
    }
    if (std::exchange(was_silent_, false) && homing_ == Homing::Done &&
        farthest(newest_, {}) <= kUnsetCountsMax &&
        farthest(before_silence_, {}) > kRestCountsMax) {
        homing_ = Homing::NotAsked;
    }
}

// The oldest boards cannot set their encoders: their counts in the home position are subtracted.
bool PolhemDevice::home() noexcept
{
    is_to_home_ = false;
    homing_ = Homing::Asked;
    if (layout_ == PolhemLayout::Oldest) {
        for (std::size_t i = 0; i < offset_.size(); ++i) {
            offset_[i] = static_cast<std::int16_t>(parameters_.home_encoders[i] - newest_[i]);
        }
        homing_ = Homing::Done;
    }
    has_heard_ = false; // earlier reports no longer count
    return writeNow(polhemHomeCommand(layout_, parameters_.home_encoders));
}

bool PolhemDevice::isCloseToHome() const noexcept
{
    return farthest(newest_, parameters_.home_encoders) <= kRestCountsMax;
}

// Waits for a report, then takes the newest of the queued ones.
bool PolhemDevice::readNewest() noexcept
{
    int patience_ms = kReadPatienceMs;
    for (int i = 0; i < kReportsAtOnceMax; ++i) {
        std::array<unsigned char, kReportBytesMax> bytes{};
        const int read = api_.read_timeout(handle_.get(), bytes.data(), bytes.size(), patience_ms);
        if (read < 0) {
            return false;
        }
        if (read == 0) {
            break;
        }
        const auto size = std::min(static_cast<std::size_t>(read), bytes.size());
        if (const auto report = parsePolhemReport({bytes.data(), size})) {
            take(*report, size);
        }
        patience_ms = 0;
    }
    return true;
}

void PolhemDevice::take(const PolhemReport& report, std::size_t bytes) noexcept
{
    constexpr std::size_t kOldestBytes = 8;
    if (!has_heard_ && bytes == kOldestBytes) {
        layout_ = PolhemLayout::Oldest;
    }
    is_to_home_ = is_to_home_ || report.wants_calibration;
    newest_ = report.encoders;
    heard_ = Clock::now();
    has_heard_ = true;
}

bool PolhemDevice::writeNow(const PolhemCommand& command) noexcept
{
    return api_.write(handle_.get(), command.bytes.data(), command.size) >= 0;
}

PolhemEncoders PolhemDevice::corrected(const PolhemEncoders& encoders) const noexcept
{
    PolhemEncoders sum{};
    for (std::size_t i = 0; i < sum.size(); ++i) {
        sum[i] = static_cast<std::int16_t>(encoders[i] + offset_[i]);
    }
    return sum;
}

} // namespace marsview
