// Encodes tiles for a GeoTIFF.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace marsview {

/// TIFF tag 317: the transformation of a row of samples for better compression.
enum class TiffPredictor : std::uint16_t {
    None = 1,
    Horizontal = 2,    // differences of neighbors; integers
    FloatingPoint = 3, // differences of bytes, with corresponding bytes of the samples grouped
};

/// Deflates a tile of rows of `row_samples` samples of `sample_bytes` bytes (1, 2, 4 or 8) in the
/// machine's byte order. `tile` is overwritten. Empty if memory allocation fails. Any thread.
std::vector<std::byte> encodeTile(std::span<std::byte> tile,
                                  std::size_t row_samples,
                                  std::size_t sample_bytes,
                                  TiffPredictor predictor);

/// Decodes what encodeTile() made for a tile of the size of `tile`. False if it is damaged.
bool decodeTile(std::span<const std::byte> encoded,
                std::size_t row_samples,
                std::size_t sample_bytes,
                TiffPredictor predictor,
                std::span<std::byte> tile);

} // namespace marsview
