// Terrain made of noise: rough at every scale, the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace marsview::test {

/// Columns × rows heights in row-major order: up to eleven octaves of value noise, each half as
/// high and half as wide as the one before, scaled to a root mean square slope of 0.3 a cell.
std::vector<float> fractalHeights(std::size_t columns, std::size_t rows, std::uint64_t seed);

} // namespace marsview::test
