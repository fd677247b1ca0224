// The loops that sounds of contact are made of.
#pragma once

#include <cstdint>
#include <vector>

namespace marsview {

inline constexpr int kLoopRateHz = 44100;
/// Of the tone's loop, played at pitch 1: 200 samples a period.
inline constexpr double kLoopToneHz = 220.5;

/// Two seconds of noise, mono, of a sound like sand: softer towards high notes. Its end goes on at
/// its beginning. The same on every machine.
std::vector<std::int16_t> noiseLoop();

/// A tone with two overtones, so that small loudspeakers let it be heard. Its end goes on at its
/// beginning.
std::vector<std::int16_t> toneLoop();

} // namespace marsview
