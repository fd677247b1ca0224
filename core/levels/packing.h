// Compressing arrays of numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace marsview {

/// An array of numbers, row by row.
struct PackShape {
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::size_t element_bytes = 1; // 1, 2, 4 or 8
    std::size_t interleaved = 1;   // 1 or 2: distance to the preceding number that it resembles

    std::size_t bytes() const noexcept { return columns * rows * element_bytes; }
};

/// Packing reduces the size by at most this factor.
inline constexpr std::uint64_t kPackRatioMax = 1040;

/// Differences from the values predicted by neighbors, grouped by byte and deflated, or left
/// uncompressed if deflate does not make them shorter. `rest` follows the array and is compressed
/// with it. Any thread.
std::vector<std::byte> packed(const PackShape& shape,
                              std::span<const std::byte> array,
                              std::span<const std::byte> rest = {});

/// False if `bytes` is not the result of packed() for such an array and rest.
bool unpack(std::span<const std::byte> bytes,
            const PackShape& shape,
            std::span<std::byte> array,
            std::span<std::byte> rest = {});

} // namespace marsview
