// Tiles as a GeoTIFF stores them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace marsview {

/// TIFF's tag 317: what is done to a row of samples so that it compresses better.
enum class TiffPredictor : std::uint16_t {
    None = 1,
    Horizontal = 2,    // differences of neighbours; whole numbers
    FloatingPoint = 3, // differences of bytes, the samples' like bytes side by side
};

/// Deflates a tile of rows of `row_samples` samples of `sample_bytes` bytes (1, 2, 4 or 8) in the
/// machine's byte order. `tile` is used up. Empty where there is no memory. Any thread.
std::vector<std::byte> encodeTile(std::span<std::byte> tile,
                                  std::size_t row_samples,
                                  std::size_t sample_bytes,
                                  TiffPredictor predictor);

} // namespace marsview
