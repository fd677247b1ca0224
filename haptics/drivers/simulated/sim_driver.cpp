#include "haptics/drivers/simulated/sim_driver.h"

#include "core/base/split_mix.h"
#include "haptics/drivers/support/uri_parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <utility>

namespace marsview {
namespace {

constexpr WorkspaceBox kWorkspace{{-0.08, -0.06, -0.06}, {0.08, 0.06, 0.06}};
constexpr double kInsideM = 0.01;   // strokes reverse this far from the walls
constexpr double kLiftM = 0.006;    // of a lift, so that the stylus stays in the picture
constexpr double kOutsideM = 0.001; // of the box of its strokes, where it lifts off to return

// The options with the names and units of the URI.
struct UriNumbers {
    double tremor_mm = 0.0;
    double encoder_mm = 0.02;
    double delay_ms = 0.0;
    double seed = 1.0;
    double swipe_cells = 0.0;
    double cell_m = 0.0;
};

Status readAddress(std::string_view address, SimOptions& options, UriNumbers& numbers)
{
    return readUriParameters(fmt::format("sim:{}", address), address,
                             {{"mass", &options.hand.mass_kg, 0.001, 10.0},
                              {"damping", &options.hand.damping_n_s_per_m, 0.0, 1000.0},
                              {"grip", &options.hand.grip_n_per_m, 0.0, 1e5},
                              {"tremor_mm", &numbers.tremor_mm, 0.0, 10.0},
                              {"encoder_mm", &numbers.encoder_mm, 0.0, 10.0},
                              {"delay_ms", &numbers.delay_ms, 0.0, HandOptions::kDelayMaxS * 1e3},
                              {"seed", &numbers.seed, 0.0, 1e15},
                              {"force", &options.force_n_peak, 0.0, 40.0},
                              {"stiffness", &options.stiffness_n_per_m_max, 0.0, 1e5},
                              {"press", &options.press_n, 0.0, 10.0},
                              {"lift_s", &options.lift_s, 0.0, 1e6},
                              {"grab_s", &options.grab_s, 0.0, 1e6},
                              {"twist", &options.twist_deg_per_s, -720.0, 720.0},
                              {"speed", &options.speed_m_per_s, 0.0, 10.0},
                              {"swipe", &numbers.swipe_cells, 0.0, 1e6},
                              {"cell_m", &numbers.cell_m, 0.0, 1.0}});
}

class SimDriver final : public DeviceDriver {
public:
    std::string_view scheme() const noexcept override { return "sim"; }
    std::vector<FoundDevice> find() override { return {{"sim:", "Simulated hand", ""}}; }
    // The width of a cell, which a swipe needs, may be added later.
    Status checkAddress(std::string_view address) const override
    {
        SimOptions options;
        UriNumbers numbers;
        return readAddress(address, options, numbers);
    }
    Result<std::unique_ptr<HapticDevice>> open(std::string_view address) override
    {
        const std::string uri = fmt::format("sim:{}", address);
        SimOptions options;
        UriNumbers numbers;
        const Status read = readAddress(address, options, numbers);
        if (!read) {
            return read.error();
        }
        if (numbers.swipe_cells > 0.0) {
            if (numbers.cell_m == 0.0) {
                return Error{ErrorCode::Invalid,
                             uri +
                                 ": swipe is in cells per update; set cell_m to the width of a "
                                 "cell at the device, in meters"};
            }
            options.speed_m_per_s = numbers.swipe_cells * numbers.cell_m * options.rate_hz;
        }
        options.hand.tremor_m = numbers.tremor_mm * 1e-3;
        options.hand.encoder_m = numbers.encoder_mm * 1e-3;
        options.hand.delay_s = numbers.delay_ms * 1e-3;
        options.hand.seed = static_cast<std::uint64_t>(numbers.seed);
        return std::unique_ptr<HapticDevice>(new SimDevice(options));
    }
};

double distanceTo(double at, double low, double high) noexcept
{
    return std::abs(at - std::clamp(at, low, high));
}

// Whether `seconds` lies in the last `share` of an interval of `every_s`.
bool isTimeFor(double every_s, double share, double seconds) noexcept
{
    return every_s > 0.0 && std::fmod(seconds, every_s) > (1.0 - share) * every_s;
}

} // namespace

SimDevice::SimDevice(const SimOptions& options)
    : options_(options)
    , hand_(options.hand)
    , random_state_(options.hand.seed)
{
    capabilities_.name = "Simulated hand";
    capabilities_.workspace = kWorkspace;
    capabilities_.force_n_peak = options.force_n_peak;
    capabilities_.force_n_continuous = options.force_n_peak;
    capabilities_.stiffness_n_per_m_max = options.stiffness_n_per_m_max;
    capabilities_.rate_hz = options.rate_hz;
    heading_rad_ = 2.0 * std::numbers::pi * nextRandom(random_state_);
    strokes_ = {{kWorkspace.low.x + kInsideM, kWorkspace.low.y + kInsideM, kWorkspace.low.z},
                {kWorkspace.high.x - kInsideM, kWorkspace.high.y - kInsideM, kWorkspace.high.z}};
}

void SimDevice::strokeWithin(const WorkspaceBox& box) noexcept
{
    const auto within = [](double low, double high, double low_max, double high_max) {
        const double bounded_low = std::clamp(low, low_max, high_max);
        return std::pair(bounded_low, std::clamp(high, bounded_low, high_max));
    };
    const auto [west, east] =
        within(box.low.x, box.high.x, kWorkspace.low.x + kInsideM, kWorkspace.high.x - kInsideM);
    const auto [south, north] =
        within(box.low.y, box.high.y, kWorkspace.low.y + kInsideM, kWorkspace.high.y - kInsideM);
    const double lowest = std::clamp(box.low.z, kWorkspace.low.z, kWorkspace.high.z - kInsideM);
    strokes_ = {{west, south, lowest}, {east, north, kWorkspace.high.z}};
}

DeviceStatus SimDevice::read(DeviceSample& sample) noexcept
{
    wander();
    hand_.advance(1.0 / options_.rate_hz);
    const bool is_grabbing = isTimeFor(options_.grab_s, 0.2, hand_.seconds());
    if (is_grabbing) {
        twist_rad_ += options_.twist_deg_per_s * std::numbers::pi / 180.0 / options_.rate_hz;
    }
    sample = {.position = hand_.measured(),
              .twist_rad = twist_rad_,
              .buttons = is_grabbing ? 1U : 0U,
              .time = std::chrono::steady_clock::now()};
    return DeviceStatus::Fine;
}

DeviceStatus SimDevice::write(const Vec3& force_n) noexcept
{
    hand_.push(force_n);
    return DeviceStatus::Fine;
}

// Slightly curved strokes that reverse before the walls. The hand presses on the stylus with a
// constant force, so that it follows the surface.
void SimDevice::wander() noexcept
{
    const double dt_s = 1.0 / options_.rate_hz;
    if (until_turn_s_ <= 0.0) {
        until_turn_s_ = 0.1 + 0.4 * nextRandom(random_state_);
        turn_rad_per_s_ = 4.0 * (2.0 * nextRandom(random_state_) - 1.0);
    }
    until_turn_s_ -= dt_s;
    heading_rad_ += turn_rad_per_s_ * dt_s;
    const double speed = options_.speed_m_per_s;
    Vec3 velocity{speed * std::cos(heading_rad_), speed * std::sin(heading_rad_), 0.0};
    // A slope may push the stylus out of the box before the aim is at its side.
    const WorkspacePoint stylus = hand_.position();
    const auto isLeaving = [](double aim, double hand, double v, double low, double high) {
        return (std::min(aim, hand) <= low && v < 0.0) || (std::max(aim, hand) >= high && v > 0.0);
    };
    if (isLeaving(aim_.x, stylus.x, velocity.x, strokes_.low.x, strokes_.high.x)) {
        heading_rad_ = std::numbers::pi - heading_rad_;
        velocity.x = -velocity.x;
    }
    if (isLeaving(aim_.y, stylus.y, velocity.y, strokes_.low.y, strokes_.high.y)) {
        heading_rad_ = -heading_rad_;
        velocity.y = -velocity.y;
    }
    aim_ = aim_ + velocity * dt_s;
    // Returns to the stroke box faster than any stroke, but without a jump.
    constexpr double kReturnMPerS = 0.5;
    const auto returned = [dt_s](double at, double low, double high) {
        return at + std::clamp(std::clamp(at, low, high) - at, -kReturnMPerS * dt_s,
                               kReturnMPerS * dt_s);
    };
    aim_.x = returned(aim_.x, strokes_.low.x, strokes_.high.x);
    aim_.y = returned(aim_.y, strokes_.low.y, strokes_.high.y);
    // Outside the box it comes back through the air: a wall would hold it there for good.
    const bool is_outside =
        std::max(distanceTo(stylus.x, strokes_.low.x, strokes_.high.x),
                 distanceTo(stylus.y, strokes_.low.y, strokes_.high.y)) > kOutsideM;
    const bool is_lifting = is_outside || isTimeFor(options_.lift_s, 0.1, hand_.seconds());
    const double lean_m =
        options_.hand.grip_n_per_m > 0.0 ? options_.press_n / options_.hand.grip_n_per_m : 0.0;
    const double up_m = is_lifting ? 2.0 * lean_m : -lean_m;
    if (!is_lifting) {
        lift_from_m_ = stylus.z;
    }
    const double highest_m =
        is_outside ? kWorkspace.high.z : std::min(kWorkspace.high.z, lift_from_m_ + kLiftM);
    aim_.z = std::clamp(stylus.z + up_m, kWorkspace.low.z, highest_m);
    if (aim_.z < strokes_.low.z) { // up as fast as it lifts
        aim_.z = std::min(stylus.z + 2.0 * lean_m, strokes_.low.z);
    }
    hand_.aimAt(aim_, velocity);
}

std::unique_ptr<DeviceDriver> makeSimDriver()
{
    return std::make_unique<SimDriver>();
}

} // namespace marsview
