#include "core/prepare/tiff/tile_encoding.h"

#include "core/base/check.h"
#include "core/base/deflate.h"

#include <cpl_conv.h>

#include <bit>
#include <cstring>

namespace marsview {
namespace {

// Measured on terrain, level 1 against 6: 9 % larger in a sixth of the time.
constexpr int kDeflateLevel = 1;

// T is unsigned: differences wrap around, as the standard defines.
template <typename T>
void differences(std::span<std::byte> tile, std::size_t row_samples)
{
    std::vector<T> row(row_samples);
    const std::size_t row_bytes = row_samples * sizeof(T);
    for (std::size_t at = 0; at < tile.size(); at += row_bytes) {
        std::memcpy(row.data(), tile.data() + at, row_bytes);
        for (std::size_t i = row_samples - 1; i > 0; --i) {
            row[i] = static_cast<T>(row[i] - row[i - 1]);
        }
        std::memcpy(tile.data() + at, row.data(), row_bytes);
    }
}

// Adobe Photoshop TIFF Technical Note 3: the most significant bytes of all samples of the row come
// first.
void byteDifferences(std::span<std::byte> tile, std::size_t row_samples, std::size_t sample_bytes)
{
    const std::size_t row_bytes = row_samples * sample_bytes;
    std::vector<std::byte> row(row_bytes);
    for (std::size_t at = 0; at < tile.size(); at += row_bytes) {
        std::byte* const samples = tile.data() + at;
        for (std::size_t i = 0; i < row_samples; ++i) {
            for (std::size_t b = 0; b < sample_bytes; ++b) {
                const std::size_t significance =
                    std::endian::native == std::endian::little ? sample_bytes - 1 - b : b;
                row[significance * row_samples + i] = samples[i * sample_bytes + b];
            }
        }
        for (std::size_t i = row_bytes - 1; i > 0; --i) {
            row[i] = static_cast<std::byte>(static_cast<unsigned char>(row[i]) -
                                            static_cast<unsigned char>(row[i - 1]));
        }
        std::memcpy(samples, row.data(), row_bytes);
    }
}

template <typename T>
void sums(std::span<std::byte> tile, std::size_t row_samples)
{
    std::vector<T> row(row_samples);
    const std::size_t row_bytes = row_samples * sizeof(T);
    for (std::size_t at = 0; at < tile.size(); at += row_bytes) {
        std::memcpy(row.data(), tile.data() + at, row_bytes);
        for (std::size_t i = 1; i < row_samples; ++i) {
            row[i] = static_cast<T>(row[i] + row[i - 1]);
        }
        std::memcpy(tile.data() + at, row.data(), row_bytes);
    }
}

void byteSums(std::span<std::byte> tile, std::size_t row_samples, std::size_t sample_bytes)
{
    const std::size_t row_bytes = row_samples * sample_bytes;
    std::vector<std::byte> row(row_bytes);
    for (std::size_t at = 0; at < tile.size(); at += row_bytes) {
        std::byte* const samples = tile.data() + at;
        std::memcpy(row.data(), samples, row_bytes);
        for (std::size_t i = 1; i < row_bytes; ++i) {
            row[i] = static_cast<std::byte>(static_cast<unsigned char>(row[i]) +
                                            static_cast<unsigned char>(row[i - 1]));
        }
        for (std::size_t b = 0; b < sample_bytes; ++b) {
            const std::size_t significance =
                std::endian::native == std::endian::little ? sample_bytes - 1 - b : b;
            for (std::size_t i = 0; i < row_samples; ++i) {
                samples[i * sample_bytes + b] = row[significance * row_samples + i];
            }
        }
    }
}

} // namespace

bool decodeTile(std::span<const std::byte> encoded,
                std::size_t row_samples,
                std::size_t sample_bytes,
                TiffPredictor predictor,
                std::span<std::byte> tile)
{
    MARSVIEW_CHECK(tile.size() % (row_samples * sample_bytes) == 0);
    if (!inflate(encoded, tile)) {
        return false;
    }
    if (predictor == TiffPredictor::FloatingPoint) {
        byteSums(tile, row_samples, sample_bytes);
    } else if (predictor == TiffPredictor::Horizontal) {
        switch (sample_bytes) {
        case 1:
            sums<std::uint8_t>(tile, row_samples);
            break;
        case 2:
            sums<std::uint16_t>(tile, row_samples);
            break;
        case 4:
            sums<std::uint32_t>(tile, row_samples);
            break;
        default:
            sums<std::uint64_t>(tile, row_samples);
        }
    }
    return true;
}

std::vector<std::byte> encodeTile(std::span<std::byte> tile,
                                  std::size_t row_samples,
                                  std::size_t sample_bytes,
                                  TiffPredictor predictor)
{
    MARSVIEW_CHECK(tile.size() % (row_samples * sample_bytes) == 0);
    switch (predictor) {
    case TiffPredictor::None:
        break;
    case TiffPredictor::Horizontal:
        switch (sample_bytes) {
        case 1:
            differences<std::uint8_t>(tile, row_samples);
            break;
        case 2:
            differences<std::uint16_t>(tile, row_samples);
            break;
        case 4:
            differences<std::uint32_t>(tile, row_samples);
            break;
        default:
            differences<std::uint64_t>(tile, row_samples);
        }
        break;
    case TiffPredictor::FloatingPoint:
        byteDifferences(tile, row_samples, sample_bytes);
        break;
    }
    // GDAL deflates with libdeflate where it was built with it, three times as fast as zlib.
    std::vector<std::byte> encoded(deflatedBytesMax(tile.size()) + 64);
    std::size_t bytes = 0;
    if (CPLZLibDeflate(tile.data(), tile.size(), kDeflateLevel, encoded.data(), encoded.size(),
                       &bytes) == nullptr) {
        return {};
    }
    encoded.resize(bytes);
    encoded.shrink_to_fit();
    return encoded;
}

} // namespace marsview
