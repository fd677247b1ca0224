// The splitmix64 generator: pseudo-random numbers that are the same on every platform.
#pragma once

#include <cstdint>

namespace marsview {

/// Increment of the state for each number: 2^64 divided by the golden ratio.
inline constexpr std::uint64_t kSplitMixStep = 0x9e3779b97f4a7c15U;

/// The finalizer: every bit of `x` changes about half of the bits of the result. Bijective.
constexpr std::uint64_t splitMix(std::uint64_t x) noexcept
{
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
}

/// The next number in [0, 1); `state` starts as the seed. Reentrant.
constexpr double nextRandom(std::uint64_t& state) noexcept
{
    state += kSplitMixStep;
    return static_cast<double>(splitMix(state) >> 11U) * 0x1p-53;
}

} // namespace marsview
