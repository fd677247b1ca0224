// Checksums and compression as in zlib's format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace marsview {

/// CRC-32 of bytes that follow others whose CRC-32 is `before`.
std::uint32_t crc32Of(std::span<const std::byte> bytes, std::uint32_t before = 0) noexcept;

/// Adler-32 of bytes that follow others whose Adler-32 is `before`.
std::uint32_t adler32Of(std::span<const std::byte> bytes, std::uint32_t before = 1) noexcept;

/// No stream of zlib's format for so many bytes is longer.
std::size_t deflatedBytesMax(std::size_t plain_bytes) noexcept;

/// A stream of zlib's format. `effort` is 1 (fast) to 12 (small).
std::vector<std::byte> deflated(std::span<const std::byte> plain, int effort);

/// Fills `plain` from a stream of zlib's format. False if `stream` is damaged, or is not one of
/// exactly so many bytes.
bool inflate(std::span<const std::byte> stream, std::span<std::byte> plain);

} // namespace marsview
