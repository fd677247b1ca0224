#include "core/terrain/packing.h"

#include "core/base/check.h"
#include "core/base/raw_array.h"

#include <algorithm>
#include <cstring>
#include <libdeflate.h>
#include <memory>

namespace marsview {
namespace {

constexpr std::byte kStored{0};
constexpr std::byte kDeflated{1};

// Beyond, deflating takes twice as long for 2 % on elevation.
constexpr int kEffort = 5;

struct FreeDeflate {
    void operator()(libdeflate_compressor* deflate) const { libdeflate_free_compressor(deflate); }
    void operator()(libdeflate_decompressor* inflate) const
    {
        libdeflate_free_decompressor(inflate);
    }
};

template <typename F>
void dispatchUnsigned(std::size_t bytes, F&& function)
{
    switch (bytes) {
    case 1:
        return function(std::uint8_t{});
    case 2:
        return function(std::uint16_t{});
    case 4:
        return function(std::uint32_t{});
    case 8:
        return function(std::uint64_t{});
    default:
        MARSVIEW_CHECK(false);
    }
}

template <typename T>
T load(const std::byte* from)
{
    T value;
    std::memcpy(&value, from, sizeof(T));
    return value;
}

// Calls `function(i, before)` for the index of every number and that of the one it resembles, or
// its own for the very first ones, which resemble 0.
template <typename F>
void eachNumber(const PackShape& shape, F&& function)
{
    const std::size_t leading = std::min(shape.interleaved, shape.columns);
    for (std::size_t row = 0; row < shape.rows; ++row) {
        const std::size_t first = row * shape.columns;
        for (std::size_t i = first; i < first + leading; ++i) {
            function(i, row == 0 ? i : i - shape.columns); // of the row above
        }
        for (std::size_t i = first + leading; i < first + shape.columns; ++i) {
            function(i, i - shape.interleaved);
        }
    }
}

template <typename T>
void difference(const PackShape& shape, const std::byte* numbers, std::byte* sorted)
{
    const std::size_t count = shape.columns * shape.rows;
    eachNumber(shape, [&](std::size_t i, std::size_t before) {
        const T reference = before == i ? T{} : load<T>(numbers + before * sizeof(T));
        const auto step = static_cast<T>(load<T>(numbers + i * sizeof(T)) - reference);
        for (std::size_t byte = 0; byte < sizeof(T); ++byte) {
            sorted[byte * count + i] = static_cast<std::byte>((step >> (8 * byte)) & 0xFFU);
        }
    });
}

template <typename T>
void sum(const PackShape& shape, const std::byte* sorted, std::byte* numbers)
{
    const std::size_t count = shape.columns * shape.rows;
    eachNumber(shape, [&](std::size_t i, std::size_t before) {
        T value = before == i ? T{} : load<T>(numbers + before * sizeof(T));
        for (std::size_t byte = 0; byte < sizeof(T); ++byte) {
            value = static_cast<T>(
                value + static_cast<T>(static_cast<T>(sorted[byte * count + i]) << (8 * byte)));
        }
        std::memcpy(numbers + i * sizeof(T), &value, sizeof(T));
    });
}

} // namespace

std::vector<std::byte>
packed(const PackShape& shape, std::span<const std::byte> array, std::span<const std::byte> rest)
{
    MARSVIEW_CHECK(array.size() == shape.bytes());
    std::vector<std::byte> plain(array.size() + rest.size());
    dispatchUnsigned(shape.element_bytes, [&](auto zero) {
        difference<decltype(zero)>(shape, array.data(), plain.data());
    });
    std::copy(rest.begin(), rest.end(), plain.begin() + static_cast<std::ptrdiff_t>(array.size()));
    const std::unique_ptr<libdeflate_compressor, FreeDeflate> deflate(
        libdeflate_alloc_compressor(kEffort));
    MARSVIEW_CHECK(deflate != nullptr);
    std::vector<std::byte> bytes(1 + libdeflate_zlib_compress_bound(deflate.get(), plain.size()));
    const std::size_t size = libdeflate_zlib_compress(deflate.get(), plain.data(), plain.size(),
                                                      bytes.data() + 1, bytes.size() - 1);
    MARSVIEW_CHECK(size > 0);
    if (size >= plain.size()) {
        bytes.resize(1 + plain.size());
        bytes[0] = kStored;
        std::copy(plain.begin(), plain.end(), bytes.begin() + 1);
    } else {
        bytes.resize(1 + size);
        bytes[0] = kDeflated;
    }
    return bytes;
}

bool unpack(std::span<const std::byte> bytes,
            const PackShape& shape,
            std::span<std::byte> array,
            std::span<std::byte> rest)
{
    MARSVIEW_CHECK(array.size() == shape.bytes());
    if (bytes.empty()) {
        return false;
    }
    const std::span<const std::byte> content = bytes.subspan(1);
    RawArray<std::byte> inflated;
    const std::size_t plain_bytes = array.size() + rest.size();
    const std::byte* plain = content.data();
    if (bytes[0] == kDeflated) {
        inflated = RawArray<std::byte>(plain_bytes);
        const std::unique_ptr<libdeflate_decompressor, FreeDeflate> inflate(
            libdeflate_alloc_decompressor());
        MARSVIEW_CHECK(inflate != nullptr);
        std::size_t used = 0;
        std::size_t size = 0;
        if (libdeflate_zlib_decompress_ex(inflate.get(), content.data(), content.size(),
                                          inflated.data(), plain_bytes, &used,
                                          &size) != LIBDEFLATE_SUCCESS ||
            size != plain_bytes || used != content.size()) {
            return false;
        }
        plain = inflated.data();
    } else if (bytes[0] != kStored || content.size() != plain_bytes) {
        return false;
    }
    dispatchUnsigned(shape.element_bytes,
                     [&](auto zero) { sum<decltype(zero)>(shape, plain, array.data()); });
    std::copy_n(plain + array.size(), rest.size(), rest.begin());
    return true;
}

std::uint32_t checksum(std::span<const std::byte> bytes)
{
    return libdeflate_crc32(0, bytes.data(), bytes.size());
}

} // namespace marsview
