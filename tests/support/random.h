// Random numbers for tests: seeded, and a failing test prints the seed.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

namespace marsview::test {

/// The seed of this run: MARSVIEW_TEST_SEED from the environment, or 20240229.
inline std::uint64_t testSeed()
{
    const char* text = std::getenv("MARSVIEW_TEST_SEED"); // NOLINT(concurrency-mt-unsafe)
    return text != nullptr ? std::strtoull(text, nullptr, 10) : 20240229;
}

/// A stream of random numbers. The same seed gives the same numbers on every machine: only the
/// engine of the standard library is used, because its output is specified.
class Random {
public:
    explicit Random(std::uint64_t seed = testSeed())
        : engine_(seed)
        , trace_(__FILE__, __LINE__, "MARSVIEW_TEST_SEED=" + std::to_string(seed))
    {}

    std::uint64_t bits() { return engine_(); }
    /// In [0, 1).
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    /// In [low, high).
    double uniform(double low, double high) { return low + (high - low) * unit(); }
    /// In [0, count).
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(bits() % count); }
    /// With probability `p`.
    bool chance(double p) { return unit() < p; }

private:
    std::mt19937_64 engine_;
    testing::ScopedTrace trace_; // every failure during the stream's lifetime prints its seed
};

} // namespace marsview::test
