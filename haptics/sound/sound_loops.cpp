#include "haptics/sound/sound_loops.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

namespace marsview {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kFullScale = 32767.0;

} // namespace

std::vector<std::int16_t> noiseLoop()
{
    constexpr std::size_t kSamples = std::size_t{2} * kLoopRateHz;
    constexpr double kSoftness = 0.6; // of a one-pole low-pass
    constexpr double kRms = 0.25;     // higher peaks are clipped, and rare
    std::minstd_rand random(1);       // its numbers are specified by the standard
    std::vector<double> noise(kSamples);
    for (double& sample : noise) {
        sample = static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max()) - 0.5;
    }
    // Filtered twice around, so that the second pass begins as it ends.
    double last = 0.0;
    std::vector<double> soft(kSamples);
    for (int round = 0; round < 2; ++round) {
        for (std::size_t i = 0; i < kSamples; ++i) {
            last = kSoftness * last + (1.0 - kSoftness) * noise[i];
            soft[i] = last;
        }
    }
    double energy = 0.0;
    for (const double sample : soft) {
        energy += sample * sample;
    }
    const double scale = kRms / std::sqrt(energy / static_cast<double>(kSamples));
    std::vector<std::int16_t> loop(kSamples);
    std::transform(soft.begin(), soft.end(), loop.begin(), [scale](double sample) {
        return static_cast<std::int16_t>(
            std::lround(kFullScale * std::clamp(scale * sample, -1.0, 1.0)));
    });
    return loop;
}

std::vector<std::int16_t> toneLoop()
{
    constexpr std::size_t kPeriod = 200;
    constexpr std::size_t kPeriods = 20;
    std::vector<std::int16_t> loop(kPeriod * kPeriods);
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const double phase =
            2.0 * kPi * static_cast<double>(i % kPeriod) / static_cast<double>(kPeriod);
        const double sample =
            0.7 * std::sin(phase) + 0.2 * std::sin(2.0 * phase) + 0.08 * std::sin(3.0 * phase);
        loop[i] = static_cast<std::int16_t>(std::lround(kFullScale * sample));
    }
    return loop;
}

} // namespace marsview
