// Noise terrain: rough at every scale, the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace marsview {

/// Up to eleven octaves of value noise, each half as high and half as wide as the one before,
/// scaled to a root mean square slope of 0.3 per cell. Heights are in cells. Immutable; any thread.
class FractalHeights {
public:
    /// At least 2 × 2 samples. Computes every sample once to determine the scale.
    FractalHeights(std::size_t columns, std::size_t rows, std::uint64_t seed);

    std::size_t columns() const noexcept { return columns_; }
    std::size_t rows() const noexcept { return rows_; }
    /// `heights` has columns() elements.
    void row(std::size_t row, std::span<double> heights) const;

private:
    void unscaledRow(std::size_t row, std::span<double> heights) const;

    std::size_t columns_;
    std::size_t rows_;
    std::uint64_t seed_;
    double scale_ = 1.0;
};

/// All heights in row-major order.
std::vector<float> fractalHeights(std::size_t columns, std::size_t rows, std::uint64_t seed);

} // namespace marsview
