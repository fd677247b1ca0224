// The sample loops that contact sounds are made of.
#pragma once

#include <cstdint>
#include <vector>

namespace marsview {

inline constexpr int kLoopRateHz = 44100;
/// Frequency of the tone's loop at pitch 1: 200 samples per period.
inline constexpr double kLoopToneHz = 220.5;

/// Two seconds of sand-like noise, mono, with less energy at high frequencies. Loops seamlessly.
/// The same on every machine.
std::vector<std::int16_t> noiseLoop();

/// A tone with two overtones, audible on small loudspeakers. Loops seamlessly.
std::vector<std::int16_t> toneLoop();

} // namespace marsview
