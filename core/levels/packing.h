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
    std::size_t interleaved = 1;   // 1 or 2: a number resembles the one that many before it

    std::size_t bytes() const noexcept { return columns * rows * element_bytes; }
};

/// No packed bytes are smaller than 1/kRatioMax of what they stand for.
inline constexpr std::uint64_t kPackRatioMax = 1040;

/// Differences from what neighbours lead to expect, sorted by bytes, deflated; or not deflated
/// where that is no shorter. `rest` follows the array, and is deflated with it. Any thread.
std::vector<std::byte> packed(const PackShape& shape,
                              std::span<const std::byte> array,
                              std::span<const std::byte> rest = {});

/// False where `bytes` is not what packed() makes of such an array and rest.
bool unpack(std::span<const std::byte> bytes,
            const PackShape& shape,
            std::span<std::byte> array,
            std::span<std::byte> rest = {});

} // namespace marsview
