#include "haptics/sound/contact_sound.h"

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

// For each quantity, the value of 63 % effect: typical forces, speeds and slopes.
constexpr double kForceN = 1.0;
constexpr double kSpeedMPerS = 0.05;
constexpr double kRoughnessRad = 0.15;

// A smooth surface also makes noise, or sliding over it would be silent.
constexpr double kSmoothShare = 0.25;

constexpr double kForceOctaves = 2.0;
constexpr double kHeightOctaves = 1.0;

// 0 at 0 and below, approaching 1 far above `scale`.
double saturated(double value, double scale) noexcept
{
    return value > 0.0 ? -std::expm1(-value / scale) : 0.0;
}

bool isNumber(const ContactFeel& feel) noexcept
{
    return !std::isnan(feel.force_n) && !std::isnan(feel.speed_m_per_s) &&
           !std::isnan(feel.roughness_rad) && !std::isnan(feel.height_share) &&
           !std::isnan(feel.across);
}

} // namespace

SoundState contactSound(const ContactFeel& feel) noexcept
{
    if (!feel.is_in_contact || !isNumber(feel)) {
        return {};
    }
    const double press = saturated(feel.force_n, kForceN);
    const double slide = saturated(feel.speed_m_per_s, kSpeedMPerS);
    const double rough = saturated(feel.roughness_rad, kRoughnessRad);
    const double height = std::clamp(feel.height_share, 0.0, 1.0);
    const double texture = kSmoothShare + (1.0 - kSmoothShare) * rough;
    // Pitch perception is logarithmic: octaves add up.
    const double octaves = kForceOctaves * press + kHeightOctaves * height;
    return {.noise_gain = kNoiseGainMax * press * slide * texture,
            .noise_pitch = std::clamp(0.5 * std::exp2(slide + rough), 0.5, 2.0),
            .tone_gain = kToneGainMax * press,
            .tone_hz = std::clamp(kToneHzMin * std::exp2(octaves), kToneHzMin, kToneHzMax),
            .pan = std::clamp(feel.across, -1.0, 1.0)};
}

} // namespace marsview
