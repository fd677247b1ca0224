#include "haptics/drivers/simulated/simulated_hand.h"

#include "core/base/split_mix.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace marsview {
namespace {

constexpr double kStepMaxS = 1e-4;

double quantised(double value, double step) noexcept
{
    return step > 0.0 ? std::floor(value / step + 0.5) * step : value;
}

} // namespace

SimulatedHand::SimulatedHand(const HandOptions& options, const WorkspacePoint& at) noexcept
    : options_(options)
    , aim_(at)
    , at_(at)
{
    constexpr double kTremorHz = 8.0;
    constexpr double kTremorHzMore = 4.0;
    options_.delay_s = std::clamp(options_.delay_s, 0.0, HandOptions::kDelayMaxS);
    std::uint64_t state = options_.seed;
    for (std::size_t axis = 0; axis < phases_.size(); ++axis) {
        phases_[axis] = 2.0 * std::numbers::pi * nextRandom(state);
        rad_per_s_[axis] = 2.0 * std::numbers::pi * (kTremorHz + kTremorHzMore * nextRandom(state));
    }
}

void SimulatedHand::aimAt(const WorkspacePoint& aim, const Vec3& aim_m_per_s) noexcept
{
    aim_ = aim;
    aim_m_per_s_ = aim_m_per_s;
}

void SimulatedHand::push(const Vec3& force_n) noexcept
{
    if (count_ == kPushesMax) { // full: the oldest begins early
        acting_n_ = pushes_[first_].force_n;
        first_ = (first_ + 1) % kPushesMax;
        --count_;
    }
    pushes_[(first_ + count_) % kPushesMax] = {seconds_ + options_.delay_s, force_n};
    ++count_;
}

void SimulatedHand::advance(double seconds) noexcept
{
    constexpr double kSecondsMax = 0.1;
    if (!(seconds > 0.0)) {
        return;
    }
    seconds = std::min(seconds, kSecondsMax);
    const int count = static_cast<int>(std::ceil(seconds / kStepMaxS - 1e-9));
    for (int i = 0; i < count; ++i) {
        step(seconds / count);
    }
}

void SimulatedHand::step(double seconds) noexcept
{
    // A tolerance of half a step hides the rounding of accumulated times.
    while (count_ > 0 && pushes_[first_].begin_s <= seconds_ + 0.5 * seconds) {
        acting_n_ = pushes_[first_].force_n;
        first_ = (first_ + 1) % kPushesMax;
        --count_;
    }
    // Implicit in the grip's force on the mass, so that any grip stiffness is stable.
    const Vec3 aim_at{aim_.x, aim_.y, aim_.z};
    const Vec3 at{at_.x, at_.y, at_.z};
    const Vec3 pull_n = (aim_at + tremor() - at) * options_.grip_n_per_m +
                        aim_m_per_s_ * options_.grip_n_s_per_m + acting_n_;
    const double held =
        options_.damping_n_s_per_m + options_.grip_n_s_per_m + options_.grip_n_per_m * seconds;
    velocity_m_per_s_ = (velocity_m_per_s_ * options_.mass_kg + pull_n * seconds) *
                        (1.0 / (options_.mass_kg + held * seconds));
    at_ = at_ + velocity_m_per_s_ * seconds;
    aim_ = aim_ + aim_m_per_s_ * seconds;
    seconds_ += seconds;
}

Vec3 SimulatedHand::tremor() const noexcept
{
    if (options_.tremor_m == 0.0) {
        return {};
    }
    const auto along = [this](std::size_t axis) {
        return options_.tremor_m * std::sin(phases_[axis] + rad_per_s_[axis] * seconds_);
    };
    return {along(0), along(1), along(2)};
}

WorkspacePoint SimulatedHand::measured() const noexcept
{
    const double step = options_.encoder_m;
    return {quantised(at_.x, step), quantised(at_.y, step), quantised(at_.z, step)};
}

double SimulatedHand::energyJ() const noexcept
{
    const Vec3 stretch = aim_ - at_;
    return 0.5 * (options_.mass_kg * dot(velocity_m_per_s_, velocity_m_per_s_) +
                  options_.grip_n_per_m * dot(stretch, stretch));
}

} // namespace marsview
