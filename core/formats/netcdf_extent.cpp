#include "core/formats/netcdf_extent.h"

#include "core/files/gdal_file.h"

#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace marsview {
namespace {

// Headers are a few kilobytes; longer ones are not parsed.
constexpr std::size_t kHeaderBytesMax = std::size_t{1} << 20;
constexpr std::uint64_t kPaddingMax = 3;
constexpr std::uint64_t kUnknownSize = 0xFFFFFFFF; // CDF-1 and 2: larger than can be written

// Reads successive big-endian numbers; returns none after the first missing one.
class Reader {
public:
    Reader(const std::vector<unsigned char>& bytes, int version)
        : bytes_(bytes)
        , version_(version)
    {}

    bool hasFailed() const { return has_failed_; }

    std::uint64_t number(std::size_t size)
    {
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < size; ++i) {
            value = (value << 8) | byte();
        }
        return value;
    }
    std::uint64_t tag() { return number(4); }
    std::uint64_t count() { return number(version_ == 5 ? 8 : 4); }
    std::uint64_t offset() { return number(version_ == 1 ? 4 : 8); }

    void skipPadded(std::uint64_t size)
    {
        const std::uint64_t padded = (size + 3) / 4 * 4;
        if (padded > bytes_.size() - at_) {
            has_failed_ = true;
            return;
        }
        at_ += static_cast<std::size_t>(padded);
    }
    void skipName() { skipPadded(count()); }
    void skipAttributes()
    {
        tag();
        const std::uint64_t attributes = count();
        for (std::uint64_t i = 0; i < attributes && !has_failed_; ++i) {
            skipName();
            // Sizes of the types byte, char, short, int, float, double and those of CDF-5.
            constexpr std::array<std::uint64_t, 12> kTypeBytes{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
            const std::uint64_t type = tag();
            const std::uint64_t values = count();
            if (type >= kTypeBytes.size() || values > kHeaderBytesMax) {
                has_failed_ = true;
                return;
            }
            skipPadded(values * kTypeBytes[static_cast<std::size_t>(type)]);
        }
    }

private:
    unsigned char byte()
    {
        if (at_ >= bytes_.size()) {
            has_failed_ = true;
            return 0;
        }
        return bytes_[at_++];
    }

    const std::vector<unsigned char>& bytes_;
    int version_;
    std::size_t at_ = 4; // after the magic number
    bool has_failed_ = false;
};

std::vector<unsigned char> headerOf(const std::string& path)
{
    const GdalFile file = openGdalFile(path);
    std::vector<unsigned char> bytes(file ? kHeaderBytesMax : 0);
    if (file) {
        bytes.resize(VSIFReadL(bytes.data(), 1, bytes.size(), file.get()));
    }
    return bytes;
}

} // namespace

std::optional<std::uint64_t> classicNetcdfBytes(const std::string& path)
{
    const std::vector<unsigned char> bytes = headerOf(path);
    if (bytes.size() < 4 || bytes[0] != 'C' || bytes[1] != 'D' || bytes[2] != 'F' ||
        (bytes[3] != 1 && bytes[3] != 2 && bytes[3] != 5)) {
        return std::nullopt;
    }
    Reader reader(bytes, bytes[3]);
    reader.count(); // records
    reader.tag();
    const std::uint64_t dimensions = reader.count();
    for (std::uint64_t i = 0; i < dimensions && !reader.hasFailed(); ++i) {
        reader.skipName();
        reader.count();
    }
    reader.skipAttributes();
    reader.tag();
    const std::uint64_t variables = reader.count();
    std::uint64_t end = 0;
    for (std::uint64_t i = 0; i < variables && !reader.hasFailed(); ++i) {
        reader.skipName();
        const std::uint64_t rank = reader.count();
        for (std::uint64_t d = 0; d < rank && !reader.hasFailed(); ++d) {
            reader.count();
        }
        reader.skipAttributes();
        reader.tag();
        const std::uint64_t size = reader.count();
        const std::uint64_t begin = reader.offset();
        if (size != kUnknownSize) {
            end = std::max(end, begin + size);
        }
    }
    if (reader.hasFailed() || end <= kPaddingMax) {
        return std::nullopt;
    }
    return end - kPaddingMax;
}

} // namespace marsview
