#include "haptics/loop/safety_limiter.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace marsview {
namespace {

constexpr std::array<std::string_view, kForceOffReasonCount> kNames{
    "none",          "emergency stop",  "device lost",      "device finished", "device unready",
    "device stale",  "device nonsense", "not held",         "missed deadline", "loop stalled",
    "terrain stale", "fault",           "nothing to touch",
};

// Finite also if the squares of the components overflow.
double safeLength(const Vec3& v) noexcept
{
    return std::hypot(v.x, v.y, v.z);
}

// Slightly shorter, so that rounding does not exceed the bound.
Vec3 shortened(const Vec3& v, double length_max) noexcept
{
    constexpr double kHair = 1e-15;
    const double longest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(longest > 0.0) || !(length_max > 0.0)) {
        return {};
    }
    const Vec3 unit = v * (1.0 / longest); // its length is in [1, sqrt(3)]
    if (!isFinite(unit)) {
        return {};
    }
    return unit * (length_max * (1.0 - kHair) / safeLength(unit));
}

constexpr double kForceMeantNMax = 1e6;

double bound(double value) noexcept
{
    return value > 0.0 ? std::min(value, kForceMeantNMax) : 0.0; // also for NaN
}

// `kept` + share * `yielding` with the largest share, 0 to 1, at which it is no longer than
// `length_max`. Lengths up to a million; `kept` is at most `length_max` long.
Vec3 sumWithin(const Vec3& kept, const Vec3& yielding, double length_max) noexcept
{
    // |kept|² + 2 s kept·yielding + s² |yielding|² = length_max²
    const double a = dot(yielding, yielding);
    const double half_b = dot(kept, yielding);
    const double c = dot(kept, kept) - length_max * length_max;
    const double root = std::sqrt(std::max(half_b * half_b - a * c, 0.0));
    const double share = a > 0.0 ? (root - half_b) / a : 0.0;
    return kept + yielding * std::clamp(share, 0.0, 1.0);
}

// The heat after `dt_s` with a constant force.
double heatAfter(const SafetyLimits& limits, double heat_n2, double force_n2, double dt_s) noexcept
{
    const double share = -std::expm1(-dt_s / std::max(bound(limits.heat_s), 1e-3));
    const double heat = heat_n2 + share * (force_n2 - heat_n2);
    // No permitted force makes it hotter than this; an invalid heat counts as this value.
    const double hottest_n2 = bound(limits.force_n_max) * bound(limits.force_n_max);
    return heat >= 0.0 ? std::min(heat, hottest_n2) : hottest_n2;
}

} // namespace

std::string_view forceOffReasonName(ForceOffReason reason) noexcept
{
    return kNames[std::min<std::size_t>(static_cast<std::size_t>(reason), kNames.size() - 1)];
}

double cooledHeat(const SafetyLimits& limits, double heat_n2, double seconds) noexcept
{
    return heatAfter(limits, heat_n2, 0.0, std::max(seconds, 0.0));
}

double warmForceMax(const SafetyLimits& limits, double heat_n2) noexcept
{
    const double peak_n = bound(limits.force_n_max);
    const double lasting_n = std::min(bound(limits.force_n_continuous), peak_n);
    const double hot_n2 = lasting_n * lasting_n;
    constexpr double kWarm = 0.64; // of the final heat
    if (!(hot_n2 > 0.0)) {
        return 0.0;
    }
    const double share = std::clamp((heat_n2 / hot_n2 - kWarm) / (1.0 - kWarm), 0.0, 1.0);
    const double force_n = std::sqrt(peak_n * peak_n + share * (hot_n2 - peak_n * peak_n));
    return std::clamp(force_n, lasting_n, peak_n); // also after rounding errors
}

SafetyOutput limitForce(const SafetyLimits& limits,
                        const SafetyInput& input,
                        SafetyState& state,
                        double dt_s) noexcept
{
    SafetyOutput output{.force_n = {}, .reason = input.reason};
    const bool is_time = std::isfinite(dt_s) && dt_s >= 0.0;
    if (output.reason == ForceOffReason::None &&
        (!is_time || !isFinite(input.force_n) || !isFinite(input.yielding_n))) {
        output.reason = ForceOffReason::Fault;
    }
    const bool is_step = is_time && dt_s <= kSafetyStepMaxS;
    if (output.reason == ForceOffReason::None && !is_step) {
        output.reason = ForceOffReason::MissedDeadline; // a pause
    }
    const double step_s = is_step ? dt_s : kSafetyStepFallbackS;
    const double force_n_max = bound(limits.force_n_max);
    const bool has_force = isFinite(state.force_n);
    if (!has_force || !std::isfinite(state.gain) || !std::isfinite(state.ramp_s)) {
        state = {.force_n = has_force ? state.force_n : Vec3{}, .heat_n2 = state.heat_n2};
        output.reason =
            output.reason == ForceOffReason::None ? ForceOffReason::Fault : output.reason;
    }
    const double last_n = safeLength(state.force_n);
    state.heat_n2 =
        heatAfter(limits, state.heat_n2, last_n * last_n, is_time ? dt_s : kSafetyStepFallbackS);

    const bool is_letting_go = output.reason != ForceOffReason::None;
    Vec3 wanted_n{};
    if (is_letting_go) {
        state.gain = 0.0;
        state.ramp_s = 0.0;
    } else {
        if (state.ramp_s <= 0.0) {
            state.gain = 0.0;
            state.ramp_s = std::max(bound(limits.ramp_s), 1e-6);
        } else if (input.has_changed) {
            // A ramp that has not finished keeps its duration.
            state.ramp_s = state.gain < 1.0 ? state.ramp_s : bound(limits.change_ramp_s);
            state.ramp_s = std::max(state.ramp_s, 1e-6);
            state.gain = 0.0;
        }
        state.gain = std::clamp(state.gain + step_s / state.ramp_s, 0.0, 1.0);
        wanted_n = input.force_n + input.yielding_n;
        const double warm_n_max = warmForceMax(limits, state.heat_n2);
        if (safeLength(wanted_n) > warm_n_max) {
            const Vec3 kept_n = safeLength(input.force_n) > warm_n_max
                                    ? shortened(input.force_n, warm_n_max)
                                    : input.force_n;
            const Vec3 yielding_n = safeLength(input.yielding_n) > kForceMeantNMax
                                        ? shortened(input.yielding_n, kForceMeantNMax)
                                        : input.yielding_n;
            wanted_n = shortened(sumWithin(kept_n, yielding_n, warm_n_max), warm_n_max);
        }
        wanted_n = wanted_n * state.gain;
    }

    const double rate = is_letting_go ? limits.release_n_per_s_max : limits.rate_n_per_s_max;
    const double change_n_max = bound(rate) * step_s;
    const Vec3 change_n = wanted_n - state.force_n;
    if (safeLength(change_n) > change_n_max) {
        wanted_n = state.force_n + shortened(change_n, change_n_max);
    }
    if (safeLength(wanted_n) > force_n_max) {
        wanted_n = shortened(wanted_n, force_n_max);
    }
    state.force_n = wanted_n;
    output.force_n = wanted_n;
    return output;
}

} // namespace marsview
