#include "core/levels/packing.h"

#include "core/base/check.h"
#include "core/base/deflate.h"
#include "core/base/raw_array.h"
#include "core/raster/sample_type.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <type_traits>

namespace marsview {
namespace {

constexpr std::byte kStored{0};
constexpr std::byte kDeflated{1};

// Higher levels take twice as long and save 2 % on elevations.
constexpr int kEffort = 5;

template <typename T>
T load(const std::byte* from)
{
    T value;
    std::memcpy(&value, from, sizeof(T));
    return value;
}

// Numbers are predicted as the mean of those to the left and above: of two equally noisy neighbors
// the mean is the better prediction. Differences are mapped to small unsigned numbers in the order
// 0, -1, 1, -2 …, so that their upper bytes are alike. Compared with plain differences to the left,
// tiles of noisy elevations become a fifth smaller, and their block extremes a seventh.

// Treated as signed integers, whatever the type: floats of one sign keep their order, too.
template <typename T>
T mean(T a, T b)
{
    using Signed = std::make_signed_t<T>;
    return static_cast<T>((a & b) + static_cast<T>(static_cast<Signed>(a ^ b) >> 1));
}

template <typename T>
T folded(T difference)
{
    using Signed = std::make_signed_t<T>;
    const auto sign = static_cast<T>(static_cast<Signed>(difference) >> (8 * sizeof(T) - 1));
    return static_cast<T>(static_cast<T>(difference << 1) ^ sign);
}

template <typename T>
T unfolded(T code)
{
    return static_cast<T>(static_cast<T>(code >> 1) ^ static_cast<T>(T{} - (code & 1U)));
}

// The prediction of the number at `i` from the earlier ones in `numbers`.
template <typename T>
T guess(const PackShape& shape, const std::byte* numbers, std::size_t row, std::size_t column)
{
    const std::size_t i = row * shape.columns + column;
    const auto at = [numbers](std::size_t index) { return load<T>(numbers + index * sizeof(T)); };
    if (column < shape.interleaved) {
        return row == 0 ? T{} : at(i - shape.columns);
    }
    const T left = at(i - shape.interleaved);
    return row == 0 ? left : mean(left, at(i - shape.columns));
}

template <typename T>
void difference(const PackShape& shape, const std::byte* numbers, std::byte* sorted)
{
    const std::size_t count = shape.columns * shape.rows;
    for (std::size_t row = 0; row < shape.rows; ++row) {
        for (std::size_t column = 0; column < shape.columns; ++column) {
            const std::size_t i = row * shape.columns + column;
            const T code = folded(static_cast<T>(load<T>(numbers + i * sizeof(T)) -
                                                 guess<T>(shape, numbers, row, column)));
            for (std::size_t byte = 0; byte < sizeof(T); ++byte) {
                sorted[byte * count + i] = static_cast<std::byte>((code >> (8 * byte)) & 0xFFU);
            }
        }
    }
}

// The differences of a row's numbers from their predictions, of `count` numbers in total.
template <typename T>
void readDifferences(const std::byte* sorted, std::size_t count, std::span<T> differences)
{
    for (std::size_t i = 0; i < differences.size(); ++i) {
        T code{};
        for (std::size_t byte = 0; byte < sizeof(T); ++byte) {
            code = static_cast<T>(
                code | static_cast<T>(static_cast<T>(sorted[byte * count + i]) << (8 * byte)));
        }
        differences[i] = unfolded(code);
    }
}

// The next number. Each one depends on the one before it: in a wider type, if there is one, mean
// and difference take only an addition and a shift.
template <typename T>
T next(T left, T above, T difference)
{
    if constexpr (sizeof(T) < sizeof(std::int64_t)) {
        using Signed = std::make_signed_t<T>;
        const auto wide = [](T value) { return std::int64_t{static_cast<Signed>(value)}; };
        return static_cast<T>((wide(left) + (wide(above) + 2 * wide(difference))) >> 1);
    } else {
        return mean(left, above) + difference;
    }
}

// Converts the differences of a row after the first to numbers, in `kApart` interleaved sequences.
template <std::size_t kApart, typename T>
void addUp(std::span<T> row, std::span<const T> above)
{
    std::array<T, kApart> left{};
    std::copy_n(row.begin(), kApart, left.begin());
    std::size_t i = kApart;
    for (; i + kApart <= row.size(); i += kApart) {
#pragma GCC unroll 2
        for (std::size_t k = 0; k < kApart; ++k) {
            left[k] = next(left[k], above[i + k], row[i + k]);
            row[i + k] = left[k];
        }
    }
    for (; i < row.size(); ++i) {
        row[i] = next(row[i - kApart], above[i], row[i]);
    }
}

template <typename T>
void sum(const PackShape& shape, const std::byte* sorted, std::byte* numbers)
{
    const std::size_t count = shape.columns * shape.rows;
    const std::size_t apart = std::min(shape.interleaved, shape.columns);
    std::vector<T> above(shape.columns);
    std::vector<T> row(shape.columns); // first differences, then numbers
    for (std::size_t begin = 0; begin < count; begin += shape.columns) {
        readDifferences<T>(sorted + begin, count, row);
        for (std::size_t i = 0; i < apart; ++i) {
            row[i] = static_cast<T>(row[i] + above[i]); // `above` is 0 in the first row
        }
        if (begin == 0) {
            for (std::size_t i = apart; i < shape.columns; ++i) {
                row[i] = static_cast<T>(row[i] + row[i - apart]);
            }
        } else if (apart == 1) {
            addUp<1, T>(row, above);
        } else {
            MARSVIEW_CHECK(apart == 2);
            addUp<2, T>(row, above);
        }
        std::memcpy(numbers + begin * sizeof(T), row.data(), shape.columns * sizeof(T));
        row.swap(above);
    }
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
    const std::vector<std::byte> stream = deflated(plain, kEffort);
    const bool is_shorter = stream.size() < plain.size();
    const std::vector<std::byte>& content = is_shorter ? stream : plain;
    std::vector<std::byte> bytes(1 + content.size());
    bytes[0] = is_shorter ? kDeflated : kStored;
    std::copy(content.begin(), content.end(), bytes.begin() + 1);
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
    RawArray<std::byte> unpacked;
    const std::size_t plain_bytes = array.size() + rest.size();
    const std::byte* plain = content.data();
    if (bytes[0] == kDeflated) {
        unpacked = RawArray<std::byte>(plain_bytes);
        if (!inflate(content, std::span(unpacked.data(), plain_bytes))) {
            return false;
        }
        plain = unpacked.data();
    } else if (bytes[0] != kStored || content.size() != plain_bytes) {
        return false;
    }
    dispatchUnsigned(shape.element_bytes,
                     [&](auto zero) { sum<decltype(zero)>(shape, plain, array.data()); });
    std::copy_n(plain + array.size(), rest.size(), rest.begin());
    return true;
}

} // namespace marsview
